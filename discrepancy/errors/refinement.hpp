#pragma once
// What the coarse mesh gets wrong at the fitted forces.

#include "discrepancy/conditions/joint_fit.hpp"

namespace genio {

/// Refined tongues of a description, one for all that is known of a condition, each made when first
/// needed.
class Refinement {
 public:
  Refinement(ModelDescription description, const Observations& observations)
      : description_(std::move(description)), observations_(observations) {}
  /// The same conditions with another description; known fine shapes serve as starts.
  Refinement(ModelDescription description, const Refinement& before);
  /// For every condition: the residuals of the same problem on a mesh with every element split in
  /// eight, less those of this mesh by smooth distances, in units of the noise; on half a tongue,
  /// with the mean forces of both sides, where the tongue is symmetric. Parameters of the set's
  /// models that this description has not are left out. Zero where the finer problem has no
  /// solution. What is known from a shape nearby is not computed again.
  Corrections corrections(const ConditionSet& set, const JointFit& fit);
  /// True where all of these corrections are known from shapes nearby.
  bool holds(const ConditionSet& set, const JointFit& fit) const;

 private:
  struct Tongues {
    explicit Tongues(const ModelDescription& description);
    Model coarse;
    std::unique_ptr<const Mirror> mirror;  ///< of the coarse tongue; null: not symmetric
    Model fine;                            ///< half a tongue where there is a mirror
    Model whole;                           ///< the whole fine tongue's geometry alone
    std::vector<int> node;                 ///< of `fine`, for each of `whole`
    Workspace coarse_workspace, fine_workspace;
  };
  /// What is known of a condition.
  struct Known {
    Positions coarse, fine;  ///< shapes without and with every element split (half) [m]
    Positions fitted;        ///< that the correction was asked for; empty: of another description
    Correction correction;
  };
  /// Of the fine shapes known so far the one whose coarse shape is nearest: a coarse shape between
  /// the nodes of the fine mesh is a worse start, its volumes are wrong from point to point.
  Positions nearest_fine(const Tongues& tongues, const Positions& rest,
                         const Positions& coarse) const;
  bool holds(const FittedCondition& fit, size_t condition) const;
  Correction correction(const Model& fitted, const FittedCondition& fit, size_t condition);

  ModelDescription description_;
  const Observations& observations_;
  std::map<std::map<std::string, double>, std::unique_ptr<Tongues>> tongues_;  ///< by known effects
  std::map<size_t, Known> known_;
};

}  // namespace genio
