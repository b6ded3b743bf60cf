#pragma once
// A movement as a descent. Not for other rooms.

#include "inverse/sequence/chained_prior.hpp"
#include "inverse/sequence/motion_inversion.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// Unknown j * commands + c is command c at knot j.
class MotionProblem final : public MisfitProblem {
 public:
  MotionProblem(const Model& model, const std::vector<MotionFrame>& frames, const Prior& prior,
                const MotionOptions& options, Workspace& ws);

  /// Knots between 0 and `last`, about `apart` from each other [s].
  static std::vector<double> knots(double last, double apart);

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  const Controls& controls() const { return controls_; }
  const std::vector<Comparison>& comparisons() const { return comparisons_; }
  /// The motion and the residuals at the latest point.
  const Trajectory& trajectory() const { return trajectory_; }
  const std::vector<Residuals>& residuals() const { return residuals_; }
  int simulations() const { return simulations_; }
  InferStatus stop_reason() const { return clock_.reason(); }
  double seconds() const { return clock_.seconds(); }
  Vector values() const;  ///< of the residuals, one frame's after another's
  /// Of the tongue at a frame.
  Positions shape(size_t frame) const { return shape_at(trajectory_, frames_[frame].time_s); }
  const QuadraticTerm& prior() const { return prior_.all; }
  const PriorTerms& terms() const { return terms_; }  ///< of a knot, the walk left out

  const Vector& lower() const override { return prior_.lower; }
  const Vector& upper() const override { return prior_.upper; }
  std::optional<double> value(const Vector& u) override;
  std::shared_ptr<LocalModel> local(const Vector& u) override;
  /// The same in full; kept for the latest point where there is one.
  std::shared_ptr<LocalProblem> local_problem(const Vector& u);
  bool stopped() override { return clock_.stopped(); }
  const std::string& last_failure() const override { return failure_; }
  double rms() const override;

 private:
  /// Where the motion starts, and its derivative by the first knot; empty where there is none.
  std::optional<Equilibrium> start_of(const Vector& u);
  void set_prior(const Prior& prior);

  const Model& model_;
  const std::vector<MotionFrame>& frames_;
  const MotionOptions& options_;
  Workspace& ws_;
  Workspace sensitivity_ws_;
  std::vector<Unknown> unknowns_;
  Controls controls_;
  Parameters base_;
  std::vector<Comparison> comparisons_;
  PriorTerms terms_;
  ChainedPrior prior_;
  std::optional<Equilibrium> start_;
  Vector at_;  // the latest point, and there:
  Trajectory trajectory_;
  std::vector<Residuals> residuals_;
  double value_ = 0;
  std::shared_ptr<LocalProblem> local_;  // the latest there was
  int simulations_ = 0;
  WorkClock clock_;
  std::string failure_;
};

}  // namespace genio
