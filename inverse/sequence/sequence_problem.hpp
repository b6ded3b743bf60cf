#pragma once
// The frames of a recording as one descent. Not for other rooms.

#include "inverse/sequence/chained_prior.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// One frame of a joint problem.
struct JointFrame {
  JointFrame(const Model& model, Target target, const Prior& prior, InferOptions how,
             Workspace& workspace, double walk)
      : comparison(model, std::move(target)),
        options(std::move(how)),
        objective(model, comparison, prior, options, workspace),
        walk_sd(walk) {}

  Comparison comparison;
  InferOptions options;
  Objective objective;
  double walk_sd;  ///< from the frame before
};

/// Unknowns of all frames, one frame's after another's.
class SequenceProblem final : public MisfitProblem {
 public:
  /// `groups`: frames of each thread, by the index of its first; frames of a group share a
  /// workspace.
  SequenceProblem(std::vector<std::unique_ptr<JointFrame>>& frames, std::vector<size_t> groups);

  Vector unknowns_of(const Vector& u, size_t frame) const;
  /// The walk's slope at u with respect to frame k's unknowns, of the step to it and of that from
  /// it.
  std::pair<Vector, Vector> walk_slopes(const Vector& u, size_t k) const;
  /// True for unknowns that walk; the head pose does not.
  const std::vector<bool>& walks() const { return walks_; }

  const Vector& lower() const override { return prior_.lower; }
  const Vector& upper() const override { return prior_.upper; }
  std::optional<double> value(const Vector& u) override;
  std::shared_ptr<LocalModel> local(const Vector& u) override;
  bool stopped() override;
  const std::string& last_failure() const override { return failure_; }
  double rms() const override;

  std::function<void(const Vector&)> accepted;  ///< told of every point that was linearised

 private:
  /// act(frame) for all of them, a thread a group; false where one was.
  bool each(const std::function<bool(size_t)>& act);

  std::vector<std::unique_ptr<JointFrame>>& frames_;
  std::vector<size_t> groups_;
  Eigen::Index count_;  // unknowns a frame
  std::vector<bool> walks_;
  ChainedPrior prior_;
  std::string failure_;
};

}  // namespace genio
