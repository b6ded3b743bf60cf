#include "inverse/search/global_starts.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr int evaluations = 600;
constexpr double valleys_apart = 0.05;  // of an unknown, between distinct valleys
constexpr double reach = 0.6;           // activation: beyond it the stand-in knows nothing

struct Found {
  double value;
  Vector z;
};

struct StandIn {
  const AtlasShape& shape;
  const Comparison& comparison;
  const std::vector<Unknown>& unknowns;
  const PriorTerms& prior;
  std::vector<Eigen::Index> open;
  Vector fixed;  // all unknowns, those that are not open at their values
  std::vector<Found> seen;

  Vector all(const std::vector<double>& v) const {
    Vector z = fixed;
    for (size_t i = 0; i < open.size(); ++i) z[open[i]] = v[i];
    return z;
  }
  double operator()(const std::vector<double>& v, std::vector<double>& gradient) {
    const Vector z = all(v);
    const Residuals r = comparison(shape(z), head_pose(unknowns, z));
    const double value = 0.5 * r.values.squaredNorm() + prior.value(z);
    seen.push_back({value, z});
    if (!gradient.empty()) {
      const Matrix j =
          residual_jacobian(r, shape.derivative(z)) + r.pose * pose_derivative(unknowns);
      const Vector g = j.transpose() * r.values + prior.gradient(z);
      for (size_t i = 0; i < open.size(); ++i) gradient[i] = g[open[i]];
    }
    return value;
  }
};

}  // namespace

AtlasShape::AtlasShape(const Atlas& atlas) : atlas_(atlas), knots_(atlas.names.size()) {
  const auto& base = atlas.entries.front();
  for (size_t i = 0; i < knots_.size(); ++i) {
    const auto at = Eigen::Index(i);
    knots_[i].push_back({base.unknowns[at], &base.shape, &base.by_unknown});
    for (const auto& e : atlas.entries)
      if (e.unknowns[at] != base.unknowns[at])
        knots_[i].push_back({e.unknowns[at], &e.shape, &e.by_unknown});
    std::sort(knots_[i].begin(), knots_[i].end(),
              [](const Knot& a, const Knot& b) { return a.z < b.z; });
  }
}

AtlasShape::Weights AtlasShape::weights(const std::vector<Knot>& knots, double z, bool derivative) {
  size_t k = 0;
  while (k + 2 < knots.size() && z > knots[k + 1].z) ++k;
  if (knots.size() < 2 || z <= knots[0].z)
    return {0, derivative ? 0.0 : 1.0, 0, derivative ? 1.0 : z - knots[0].z, 0};
  if (z >= knots.back().z) {
    const double beyond = z - knots.back().z;
    return {knots.size() - 2, 0, derivative ? 0.0 : 1.0, 0, derivative ? 1.0 : beyond};
  }
  const double h = knots[k + 1].z - knots[k].z, t = (z - knots[k].z) / h;
  if (derivative)  // of the cubic Hermite weights
    return {k, (6 * t * t - 6 * t) / h, (6 * t - 6 * t * t) / h, 1 - 4 * t + 3 * t * t,
            3 * t * t - 2 * t};
  return {k, 1 - 3 * t * t + 2 * t * t * t, 3 * t * t - 2 * t * t * t,
          h * (t - 2 * t * t + t * t * t), h * (t * t * t - t * t)};
}

Positions AtlasShape::operator()(const Vector& z) const {
  const Positions& base = atlas_.entries.front().shape;
  Positions x = base;
  for (size_t i = 0; i < knots_.size(); ++i) {
    const auto& knots = knots_[i];
    const auto at = Eigen::Index(i);
    const Weights w = weights(knots, z[at], false);
    x += w.a * (*knots[w.knot].shape - base) + w.slope_a * knots[w.knot].by_unknown->col(at);
    if (knots.size() > 1)
      x += w.b * (*knots[w.knot + 1].shape - base) +
           w.slope_b * knots[w.knot + 1].by_unknown->col(at);
  }
  return x;
}

Matrix AtlasShape::derivative(const Vector& z) const {
  const Positions& base = atlas_.entries.front().shape;
  Matrix d(base.size(), z.size());
  for (size_t i = 0; i < knots_.size(); ++i) {
    const auto& knots = knots_[i];
    const auto at = Eigen::Index(i);
    const Weights w = weights(knots, z[at], true);
    d.col(at) = w.a * (*knots[w.knot].shape - base) + w.slope_a * knots[w.knot].by_unknown->col(at);
    if (knots.size() > 1)
      d.col(at) += w.b * (*knots[w.knot + 1].shape - base) +
                   w.slope_b * knots[w.knot + 1].by_unknown->col(at);
  }
  return d;
}

std::vector<Atlas::Entry> valleys(const Atlas& atlas, const Comparison& comparison,
                                  const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                                  int count) {
  std::vector<Atlas::Entry> result;
  if (count <= 0 || atlas.entries.empty()) return result;
  const AtlasShape shape(atlas);
  StandIn stand_in{shape, comparison, unknowns, prior, prior.open(), prior.lower, {}};
  std::vector<double> lower, upper, start;
  for (auto i : stand_in.open) {
    const bool muscle = unknowns[size_t(i)].kind == Unknown::Kind::muscle;
    lower.push_back(prior.lower[i]);
    upper.push_back(muscle ? std::max(prior.lower[i] + 1e-3, std::min(reach, prior.upper[i]))
                           : prior.upper[i]);
    start.push_back(std::clamp(muscle ? 0.02 : 0.0, lower.back(), upper.back()));
  }
  if (start.empty()) return result;
  nlopt::srand(1987);
  const auto n = unsigned(start.size());
  nlopt::opt local(nlopt::LD_LBFGS, n), global(nlopt::G_MLSL_LDS, n);
  local.set_ftol_rel(1e-3);
  local.set_maxeval(60);
  global.set_local_optimizer(local);
  global.set_population(4);
  global.set_maxeval(evaluations);
  global.set_lower_bounds(lower), global.set_upper_bounds(upper);
  global.set_min_objective([](const std::vector<double>& v, std::vector<double>& g,
                              void* data) { return (*static_cast<StandIn*>(data))(v, g); },
                           &stand_in);
  double value = 0;
  try {
    global.optimize(start, value);
  } catch (const std::exception&) {
    // L-BFGS gives up where rounding is all that is left; what was seen counts.
  }
  auto& seen = stand_in.seen;
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Found& a, const Found& b) { return a.value < b.value; });
  for (const Found& f : seen) {
    if (int(result.size()) == count) break;
    if (std::all_of(result.begin(), result.end(), [&](const Atlas::Entry& e) {
          return (e.unknowns - f.z).cwiseAbs().maxCoeff() > valleys_apart;
        }))
      result.push_back({f.z, shape(f.z), {}});
  }
  return result;
}

}  // namespace genio
