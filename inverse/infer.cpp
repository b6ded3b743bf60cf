#include "inverse/infer.hpp"

#include "inverse/objective.hpp"
#include "inverse/optimiser.hpp"
#include "inverse/posterior.hpp"

namespace genio {

const char* to_string(InferStatus status) {
  switch (status) {
    case InferStatus::converged: return "converged";
    case InferStatus::deadline: return "deadline";
    case InferStatus::cancelled: return "cancelled";
    case InferStatus::failed: return "failed";
  }
  return "failed";
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::none: return "none";
    case Verdict::explained: return "explained";
    case Verdict::unreachable: return "unreachable";
    case Verdict::mismatch: return "mismatch";
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
  const Vector start = warm ? options.start : Vector::Constant(n, 1e-2);

  Answer answer;
  const OptimiserResult optimum = minimise(objective, start, warm, options);
  answer.iterations = optimum.iterations;
  answer.status = optimum.converged ? InferStatus::converged
                  : objective.stopped() ? objective.stop_reason() : InferStatus::failed;
  answer.message = optimum.message;
  if (answer.status == InferStatus::converged) {
    if (const auto* point = objective.derivatives(optimum.activations)) {
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
