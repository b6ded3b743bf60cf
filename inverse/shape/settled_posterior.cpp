#include "inverse/shape/settled_posterior.hpp"

#include <cmath>

namespace genio {
namespace {

constexpr int most_turns = 2;  // derivatives taken again

}  // namespace

double displacement_from_rest(const Comparison& comparison, const Positions& x) {
  const auto& nodes = comparison.line().nodes();
  double sum = 0;
  for (int a : nodes)
    sum += (node_position(x, a) - node_position(comparison.rest(), a)).squaredNorm();
  return std::sqrt(sum / double(nodes.size()));
}

SettledPosterior settled_posterior(Objective& objective, const ObjectivePoint& optimum,
                                   const Comparison& comparison, const ModelError& error) {
  const auto by = [&](const ObjectivePoint& p) {
    return acting_posterior(p, objective.unknowns(), objective.prior(), error,
                            displacement_from_rest(comparison, p.equilibrium.x));
  };
  SettledPosterior result{optimum, by(optimum)};
  for (int k = 0; k < most_turns; ++k) {
    Vector mean = result.point.activations;
    mean(result.posterior.which) = result.posterior.centre;
    const ObjectivePoint* there = objective.at(mean);
    if (!there || nonlinearity(result.point, *there) < straight) break;
    if (!(there = objective.derivatives(mean))) break;
    result.point = *there;
    result.posterior = by(result.point);
  }
  return result;
}

}  // namespace genio
