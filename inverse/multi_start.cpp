#include <algorithm>
#include <cmath>

#include "inverse/box_gaussian.hpp"
#include "inverse/infer.hpp"

namespace genio {
namespace {

constexpr double least_weight = 0.01;  // of an alternative worth telling
constexpr double apart = 3;            // posterior standard deviations between distinct optima

/// Draws of the prior within its bounds, a column each.
Matrix prior_draws(const PriorTerms& prior, int count) {
  const Eigen::Index n = prior.lower.size();
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < n; ++i)
    if (!prior.fixed(i)) free.push_back(i);
  const Vector rest = prior.lower.cwiseMax(0).cwiseMin(prior.upper);
  const Matrix h = prior.hessian()(free, free);
  const Matrix drawn = sample(
      {rest(free), prior.gradient(rest)(free), h, prior.lower(free), prior.upper(free)}, count);
  Matrix result = rest.replicate(1, count);
  for (size_t f = 0; f < free.size(); ++f) result.row(free[f]) = drawn.row(Eigen::Index(f));
  return result;
}

/// True where some unknown of `a` lies beyond the spread that either answer claims.
bool distinct(const Answer& a, const Answer& b) {
  for (size_t i = 0; i < a.commands.size(); ++i) {
    const auto &p = a.commands[i], &q = b.commands[i];
    const double spread = std::max({p.sd, q.sd, 1e-3 * p.max_force});
    if (std::abs(p.force - q.force) > apart * spread) return true;
  }
  // The same forces may hold two shapes.
  return (a.shape - b.shape).cwiseAbs().maxCoeff() > 1e-3;
}

}  // namespace

Answer infer_from_starts(const Model& model, const Target& target, const Prior& prior,
                         Workspace& ws, const InferOptions& options, int starts) {
  std::vector<Answer> found = {infer(model, target, prior, ws, options)};
  const auto commands = unknowns(model, prior, options.bilateral.value_or(target.midsagittal()));
  const Matrix draws = prior_draws(prior_terms(prior, commands), std::max(0, starts - 1));
  Answer total = found.front();
  for (Eigen::Index k = 0; k < draws.cols(); ++k) {
    InferOptions again = options;
    again.start = draws.col(k);
    again.start_shape.reset();
    if (options.deadline_s > 0) {
      again.deadline_s = options.deadline_s - total.wall_s;
      if (again.deadline_s <= 0) break;
    }
    Answer a = infer(model, target, prior, ws, again);
    total.wall_s += a.wall_s, total.iterations += a.iterations;
    total.factorizations += a.factorizations, total.forward_solves += a.forward_solves;
    if (a.status == InferStatus::cancelled) break;
    if (a.status != InferStatus::converged) continue;
    if (found.front().status != InferStatus::converged) found.clear();
    found.push_back(std::move(a));
  }
  std::sort(found.begin(), found.end(),
            [](const Answer& a, const Answer& b) { return a.log_evidence > b.log_evidence; });
  std::vector<Answer> kept;
  for (Answer& a : found)
    if (std::none_of(kept.begin(), kept.end(), [&](const Answer& k) { return !distinct(a, k); }))
      kept.push_back(std::move(a));
  double sum = 0;
  for (const Answer& a : kept) sum += std::exp(a.log_evidence - kept.front().log_evidence);
  Answer best = std::move(kept.front());
  best.weight = 1 / sum;
  for (size_t k = 1; k < kept.size(); ++k)
    if (const double w = std::exp(kept[k].log_evidence - best.log_evidence) / sum;
        w >= least_weight)
      best.alternatives.push_back({w, kept[k].commands, kept[k].rms, kept[k].shape});
  best.wall_s = total.wall_s, best.iterations = total.iterations;
  best.factorizations = total.factorizations, best.forward_solves = total.forward_solves;
  return best;
}

}  // namespace genio
