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

std::vector<std::string> names(const TradeOff& trade) {
  std::vector<std::string> result;
  for (const Share& share : trade) result.push_back(share.name);
  return result;
}

Answer infer(const Model& model, const Target& target, const Prior& prior, Workspace& ws,
             const InferOptions& options) {
  if (target.empty()) throw InputError("the target has no points");
  const Comparison comparison(model, target);
  Objective objective(model, comparison, prior, options, ws);
  const Eigen::Index n = Eigen::Index(objective.commands().size());
  const bool warm = options.start.size() == n;
  const Vector &lower = objective.prior().lower, &upper = objective.prior().upper;
  Vector start = warm ? options.start : Vector::Constant(n, 1e-2);
  start = start.cwiseMax(lower).cwiseMin(upper);

  Answer answer;
  if (!warm || options.rough_start) {
    // From rest the first steps tend to set muscles against each other far beyond what the shape
    // needs. Effort that counts more keeps them near; its optimum is a start for the real one.
    InferOptions rough = options;
    rough.tolerance = 1e-2;
    rough.max_iterations = 15;
    objective.set_prior(with_effort(prior, 0.25));
    const OptimiserResult near = minimise(objective, start, false, rough);
    objective.set_prior(prior);
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
    for (Eigen::Index i = 0; i < n; ++i)
      rounded[i] = rounded[i] < lower[i] + 1e-3   ? lower[i]
                   : rounded[i] > upper[i] - 1e-3 ? upper[i]
                                                  : rounded[i];
    const auto* point =
        options.finite_differences ? objective.value(rounded) : objective.derivatives(rounded);
    if (!point && !options.finite_differences) point = objective.derivatives(optimum.activations);
    if (point) {
      answer.activations = point->activations;
      answer.shape = point->equilibrium.x;
      answer.residuals = point->residuals;
      answer.rms = point->residuals.rms;
      answer.max = point->residuals.max;
      if (!options.finite_differences)
        summarise_posterior(objective, *point, comparison, options.model_error, answer);
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
