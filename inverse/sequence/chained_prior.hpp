#pragma once
// Priors of points in time, and of the way from each to the next.

#include "inverse/prior/prior.hpp"
#include "inverse/shape/local_problem.hpp"

namespace genio {

/// Over the unknowns of all points, one point's after another's.
struct ChainedPrior {
  QuadraticTerm all;   ///< of the points and of the walk
  QuadraticTerm walk;  ///< of the walk alone
  Vector lower, upper;
};

/// Point k's unknowns have the prior points[k] and, where walks[i] says so, a step of standard
/// deviation walk_sd[k] from point k - 1; walk_sd[0] does not count.
ChainedPrior chained(const std::vector<PriorTerms>& points, const std::vector<double>& walk_sd,
                     const std::vector<bool>& walks);

/// Standard deviation of a step from one time to another [s], smoothness_sd sqrt(dt); times that do
/// not rise are 10 ms apart.
double walk_sd(const Prior& prior, double from_s, double to_s);

/// The unknowns of each point, `count` a point.
std::vector<Vector> by_point(const Vector& all, Eigen::Index count);
/// True where `unknowns` has `count` of them for each of `points` points.
bool fits(const std::vector<Vector>& unknowns, size_t points, Eigen::Index count);

}  // namespace genio
