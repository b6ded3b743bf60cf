#include "inverse/search/mixed_optima.hpp"

#include "inverse/shape/summary.hpp"

namespace genio {
namespace {

constexpr double least_mixed = 0.05;

void add(const ActingPosterior& posterior, double weight, WeightedSamples& pool) {
  const auto& [values, weights] = posterior.samples;
  const Eigen::Index before = pool.values.cols();
  pool.values.conservativeResize(values.rows(), before + values.cols());
  pool.values.rightCols(values.cols()) = values;
  pool.weights.conservativeResize(before + values.cols());
  pool.weights.tail(values.cols()) = weight / weights.sum() * weights;
}

}  // namespace

void mix_optima(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                const std::vector<WeighedOptimum>& others, Answer& best) {
  if (!best.posterior) return;
  ActingPosterior mixed = *best.posterior;
  mixed.samples.values.resize(mixed.samples.values.rows(), 0), mixed.samples.weights.resize(0);
  add(*best.posterior, best.weight, mixed.samples);
  for (const auto& [weight, answer] : others)
    if (weight >= least_mixed && answer->posterior)
      add(*answer->posterior, weight, mixed.samples), ++best.mixed_optima;
  if (best.mixed_optima == 1) return;
  mixed.samples.weights /= mixed.samples.weights.sum();
  set_estimates(unknowns, prior, mixed, best.activations, best);
  best.posterior = std::make_shared<ActingPosterior>(std::move(mixed));
}

}  // namespace genio
