#include "inverse/shape/infer.hpp"

#include "inverse/shape/difference_descent.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/shape/summary.hpp"
#include "inverse/target/comparison.hpp"

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

void start_from(const Answer& answer, InferOptions& options) {
  options.start = answer.activations, options.start_shape = answer.shape;
  options.start_by_unknown = answer.shape_by_unknown;
}

Answer infer(const Model& model, const Target& target, const Prior& prior, Workspace& ws,
             const InferOptions& options) {
  if (target.empty()) throw InputError("the target has no points");
  const Comparison comparison(model, target);
  Objective objective(model, comparison, prior, options, ws);
  const Eigen::Index n = Eigen::Index(objective.unknowns().size());
  const bool warm = options.start.size() == n;
  Vector start = warm ? options.start : Vector::Constant(n, 1e-2);
  start = start.cwiseMax(objective.lower()).cwiseMin(objective.upper());

  Answer answer;
  const auto descent = [&](DescentOptions how) {
    how.progress = [&](int step, double rms) {
      if (options.progress) options.progress(step, rms);
      const auto* point = options.improved ? objective.latest() : nullptr;
      if (!point) return;
      Answer so_far;
      set_best_so_far(objective.unknowns(), objective.prior(), *point, so_far);
      options.improved(so_far);
    };
    const DescentResult r = options.finite_differences
                                ? descend_by_differences(objective, start, how)
                                : descend(objective, start, how);
    answer.iterations += r.solver_iterations;
    if (r.u.size() == n) start = r.u;
    return r;
  };
  if (!warm || options.rough_start) {
    // From rest the first steps tend to set muscles against each other far beyond what the shape
    // needs. Effort that counts more keeps them near; its optimum is a start for the real one.
    objective.set_prior(prior_terms(with_effort(prior, 0.25), objective.unknowns()));
    descent({15, 1e-2, {}});
    objective.set_prior(prior_terms(prior, objective.unknowns()));
  }
  const DescentResult optimum = descent({options.max_iterations, options.tolerance, {}});
  answer.status = optimum.converged     ? InferStatus::converged
                  : objective.stopped() ? objective.stop_reason()
                                        : InferStatus::failed;
  answer.message = optimum.message;
  if (optimum.converged) {
    const auto* point =
        options.finite_differences ? objective.at(start) : objective.derivatives(start);
    if (point) {
      set_optimum(*point, answer);
      if (!options.finite_differences)
        summarise_posterior(objective, *point, comparison, options.model_error, answer);
    } else {
      answer.status = objective.stopped() ? objective.stop_reason() : InferStatus::failed;
      answer.message = objective.last_failure();
    }
  }
  if (objective.stopped() && answer.status != InferStatus::converged) {
    answer.message = answer.status == InferStatus::deadline ? "the deadline passed"
                                                            : "cancelled by the requester";
    if (const auto* point = objective.latest()) {
      set_best_so_far(objective.unknowns(), objective.prior(), *point, answer);
      answer.message += "; this is the best shape so far, without intervals";
    } else {
      answer.message += " before the first step was done";
    }
  }
  answer.factorizations = objective.factorizations();
  answer.forward_solves = objective.forward_solves();
  answer.wall_s = objective.seconds();
  return answer;
}

}  // namespace genio
