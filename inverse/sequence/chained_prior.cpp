#include "inverse/sequence/chained_prior.hpp"

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double default_step = 0.01;  // between points without times [s]

using Entries = std::vector<Eigen::Triplet<double>>;

QuadraticTerm term(const Entries& entries, const std::vector<double>& values, Eigen::Index n) {
  QuadraticTerm t;
  t.rows.resize(Eigen::Index(values.size()), n);
  t.rows.setFromTriplets(entries.begin(), entries.end());
  t.values = Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size()));
  return t;
}

}  // namespace

ChainedPrior chained(const std::vector<PriorTerms>& points, const std::vector<double>& sd,
                     const std::vector<bool>& walks) {
  const auto count = Eigen::Index(walks.size()), n = count * Eigen::Index(points.size());
  ChainedPrior result;
  result.lower.resize(n), result.upper.resize(n);
  Entries all, walk;
  std::vector<double> values, steps;
  for (size_t k = 0; k < points.size(); ++k) {
    const PriorTerms& terms = points[k];
    const auto first = count * Eigen::Index(k);
    result.lower.segment(first, count) = terms.lower;
    result.upper.segment(first, count) = terms.upper;
    for (Eigen::Index r = 0; r < terms.rows.rows(); ++r) {
      for (Eigen::Index c = 0; c < count; ++c)
        if (terms.rows(r, c) != 0)
          all.emplace_back(int(values.size()), int(first + c), terms.rows(r, c));
      values.push_back(terms.values[r]);
    }
    for (Eigen::Index c = 0; k > 0 && c < count; ++c) {
      if (!walks[size_t(c)]) continue;
      walk.emplace_back(int(steps.size()), int(first + c), 1 / sd[k]);
      walk.emplace_back(int(steps.size()), int(first - count + c), -1 / sd[k]);
      steps.push_back(0);
    }
  }
  result.walk = term(walk, steps, n);
  for (const auto& e : walk) all.emplace_back(int(values.size()) + e.row(), e.col(), e.value());
  values.insert(values.end(), steps.begin(), steps.end());
  result.all = term(all, values, n);
  return result;
}

double walk_sd(const Prior& prior, double from_s, double to_s) {
  return prior.smoothness_sd * std::sqrt(to_s > from_s ? to_s - from_s : default_step);
}

std::vector<Vector> by_point(const Vector& all, Eigen::Index count) {
  std::vector<Vector> result;
  for (Eigen::Index first = 0; first + count <= all.size(); first += count)
    result.push_back(all.segment(first, count));
  return result;
}

bool fits(const std::vector<Vector>& unknowns, size_t points, Eigen::Index count) {
  return unknowns.size() == points &&
         std::all_of(unknowns.begin(), unknowns.end(),
                     [&](const Vector& z) { return z.size() == count; });
}

}  // namespace genio
