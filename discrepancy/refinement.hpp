#pragma once
// What the coarse mesh gets wrong at the fitted forces.

#include "discrepancy/joint_fit.hpp"

namespace genio {

/// Refined tongues of a study, each made when first needed.
class Refinement {
 public:
  explicit Refinement(const Study& study) : study_(study) {}
  /// For every condition of a fit: the residuals of the same problem on a mesh with every element
  /// split in eight, less those of this mesh, in units of the noise; on half a tongue, with the mean
  /// forces of both sides, where the tongue is symmetric. The fit may be of another study of the
  /// same conditions; parameters that this study's model has not are left out. Zero where the finer
  /// problem has no solution.
  Corrections corrections(const Study& fitted, const JointFit& fit);

 private:
  struct Tongues {
    explicit Tongues(const ModelDescription& description);
    Model coarse;
    std::unique_ptr<const Mirror> mirror;  ///< of the coarse tongue; null: not symmetric
    Model fine;       ///< half a tongue where there is a mirror
    Model seen;       ///< the whole fine tongue's geometry alone
    std::vector<int> node;  ///< of `fine`, for each of `seen`
    Workspace coarse_workspace, fine_workspace;
  };
  Vector correction(const Model& fitted, const FittedCondition& condition, size_t k);

  const Study& study_;
  std::map<size_t, std::unique_ptr<Tongues>> tongues_;
};

}  // namespace genio
