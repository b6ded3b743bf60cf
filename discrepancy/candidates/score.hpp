#pragma once
// Candidates scored without refitting: Rao's test of every parameter at its vanishing value.

#include "discrepancy/conditions/joint_fit.hpp"
#include "forward/model/hypothesis.hpp"

namespace genio {

/// A candidate: an effect that the model lacks, or a head pose that the data were laid with.
struct Candidate {
  std::string effect, where;
  std::optional<Hypothesis> hypothesis;  ///< unset: head_pose
  std::vector<FreeNumber> strengths;
  std::string label() const { return genio::label(effect, where); }
  /// True where it is there or not, see Hypothesis::is_switch().
  bool is_switch() const { return hypothesis && hypothesis->is_switch(); }
};

/// All hypotheses of a description, and the head pose unless it is estimated anyway.
std::vector<Candidate> candidates(const ModelDescription& description,
                                  const Observations& observations);

/// The residuals of a fit in whitened form, with what its free unknowns can do.
class Projection {
 public:
  Projection(const JointFit& fit, const Eigen::LLT<Matrix>& covariance);
  /// Columns of residuals, whitened, with what the unknowns absorb taken away; rows of the data,
  /// then those of the prior.
  Matrix operator()(const Matrix& columns) const;
  /// Whitened residuals and prior's, as they are at the fit.
  const Vector& residuals() const { return residuals_; }
  /// Residuals of the data alone after the fit, and their degrees of freedom.
  double chi_square() const { return chi_square_; }
  double dof() const { return dof_; }

 private:
  const Eigen::LLT<Matrix>& covariance_;
  Matrix basis_;  // of the free unknowns' tangent space, orthonormal
  Vector residuals_;
  double chi_square_ = 0, dof_ = 0;
};

/// d residuals / d strengths of a candidate at its vanishing value: stacked rows x strengths, a
/// unit of its own each. `influences`: of each condition, see influence().
Matrix signature(const Candidate& candidate, const ConditionSet& set, const JointFit& fit,
                 const std::vector<Matrix>& influences);

struct Score {
  size_t candidate = 0;
  bool moves = false;       ///< what these data show changes with it
  bool visible = false;     ///< in a way that the unknowns cannot make up for
  double statistic = 0;     ///< chi-square of Rao's test; one-sided where the sign is known
  double p = 1;             ///< its tail, for this candidate alone
  double log_evidence = 0;  ///< gain over nothing, to second order
  double scale = 1;         ///< of the typical strengths that gains most, see log_weight_of_scale()
  Vector estimate, sd;      ///< of the strengths, by one step
  double detectable = 0;    ///< times its typical strength: seen nine times in ten
  Matrix signature;         ///< see signature()
  Vector direction;         ///< its whitened, projected signature, of unit length
};

/// Log weight of the belief that a candidate is about `scale` >= 1 times as strong as it typically
/// is. Taken at the scale that suits, Gaussians weighted so have the tails of a Cauchy
/// distribution: a strong effect is surprising, not impossible.
double log_weight_of_scale(double scale);

/// Scores of all candidates, the most likely first. `level`: of the test for all of them together,
/// for `detectable`.
std::vector<Score> score(const std::vector<Candidate>& candidates, const ConditionSet& set,
                         const JointFit& fit, const std::vector<Matrix>& influences,
                         const Projection& projection, double level = 0.01);

}  // namespace genio
