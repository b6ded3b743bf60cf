#include "inverse/infer.hpp"

#include "inverse/objective.hpp"
#include "inverse/optimiser.hpp"
#include "inverse/posterior.hpp"

namespace genio {

const char* to_string(InferStatus status) {
  switch (status) {
    case InferStatus::converged:
      return "converged";
    case InferStatus::deadline:
      return "deadline";
    case InferStatus::cancelled:
      return "cancelled";
    case InferStatus::failed:
      return "failed";
  }
  return "failed";
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return "none";
    case Verdict::explained:
      return "explained";
    case Verdict::unreachable:
      return "unreachable";
    case Verdict::mismatch:
      return "mismatch";
  }
  return "none";
}

Answer infer(const Model& model, const Target& target, const Prior& prior, Workspace& ws,
             const InferOptions& options) {
  if (target.empty()) throw InputError("the target has no points");
  const Comparison comparison(model, target);
  Objective objective(model, comparison, prior, options, ws);
  const Eigen::Index n = Eigen::Index(objective.commands().size());
  const bool warm = options.start.size() == n;
  Vector start = warm ? options.start : Vector::Constant(n, 1e-2);

  Answer answer;
  if (!warm) {
    // From rest the first steps tend to set muscles against each other far beyond what the shape
    // needs. Effort that counts more keeps them near; its optimum is a start for the real one.
    InferOptions rough = options;
    rough.tolerance = 1e-2;
    rough.max_iterations = 15;
    objective.set_effort_sd(prior.effort_sd / 4);
    const OptimiserResult near = minimise(objective, start, false, rough);
    objective.set_effort_sd(prior.effort_sd);
    answer.iterations = near.iterations;
    if (near.activations.size() == n) start = near.activations;
  }
  const OptimiserResult optimum = minimise(objective, start, true, options);
  answer.iterations += optimum.iterations;
  answer.status = optimum.converged     ? InferStatus::converged
                  : objective.stopped() ? objective.stop_reason()
                                        : InferStatus::failed;
  answer.message = optimum.message;
  if (answer.status == InferStatus::converged) {
    // What the barrier holds off a bound it would reach belongs on it.
    Vector rounded = optimum.activations;
    for (auto& z : rounded) z = z < 1e-3 ? 0.0 : z > 1 - 1e-3 ? 1.0 : z;
    const auto* point = objective.derivatives(rounded);
    if (!point) point = objective.derivatives(optimum.activations);
    if (point) {
      answer.activations = point->activations;
      answer.shape = point->equilibrium.x;
      answer.residuals = point->residuals;
      answer.rms = point->residuals.rms;
      answer.max = point->residuals.max;
      summarise_posterior(objective, *point, comparison, answer);
    } else {
      answer.status = objective.stopped() ? objective.stop_reason() : InferStatus::failed;
      answer.message = objective.last_failure();
    }
  }
  if (answer.status == InferStatus::deadline) answer.message = "the deadline passed";
  if (answer.status == InferStatus::cancelled) answer.message = "cancelled by the requester";
  answer.factorizations = objective.factorizations();
  answer.forward_solves = objective.forward_solves();
  answer.wall_s = objective.seconds();
  return answer;
}

}  // namespace genio
