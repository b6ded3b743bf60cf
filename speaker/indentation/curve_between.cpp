#include "speaker/indentation/curve_between.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace genio {
namespace {

constexpr int most_nodes = 10;
constexpr double shallow = 0.03;  // of the greatest depth; below it force over depth^m is constant

std::vector<double> chebyshev_points(double low, double high) {
  std::vector<double> points;
  for (int k = 0; k < most_nodes; ++k)
    points.push_back(0.5 * (low + high) -
                     0.5 * (high - low) * std::cos(std::numbers::pi * k / (most_nodes - 1)));
  points.front() = low, points.back() = high;
  return points;
}

/// Barycentric weights of Chebyshev's points (Berrut & Trefethen 2004, SIAM Review 46).
Vector between_nodes(const std::vector<double>& nodes, double at) {
  Vector w = Vector::Zero(Eigen::Index(nodes.size()));
  for (size_t k = 0; k < nodes.size(); ++k) {
    const double apart = at - nodes[k];
    if (std::abs(apart) < 1e-12 * nodes.back())
      return Vector::Unit(Eigen::Index(nodes.size()), Eigen::Index(k));
    const bool at_end = k == 0 || k + 1 == nodes.size();
    w[Eigen::Index(k)] = (k % 2 ? -1 : 1) * (at_end ? 0.5 : 1) / apart;
  }
  return w / w.sum();
}

}  // namespace

CurveBetween::CurveBetween(const Vector& depths, Indenter indenter) {
  for (const double d : depths)
    if (d > 0 && (nodes.empty() || d > nodes.back())) nodes.push_back(d);
  const double deepest = nodes.back(), least = std::max(nodes.front(), shallow * deepest);
  std::erase_if(nodes, [&](double d) { return d < least; });
  if (nodes.empty() || nodes.front() > least) nodes.insert(nodes.begin(), least);
  const bool few = int(nodes.size()) <= most_nodes;
  if (!few) nodes = chebyshev_points(least, deepest);
  const double m = indenter == Indenter::sphere ? 1.5 : 1;
  weights = Matrix::Zero(depths.size(), Eigen::Index(nodes.size()));
  for (Eigen::Index i = 0; i < depths.size(); ++i) {
    if (!(depths[i] > 0)) continue;  // no force at the first touch
    const double at = std::max(depths[i], least);
    Vector row;
    if (few) {
      const auto node = std::find(nodes.begin(), nodes.end(), at) - nodes.begin();
      row = Vector::Unit(Eigen::Index(nodes.size()), node);
    } else {
      row = between_nodes(nodes, at);
    }
    for (size_t k = 0; k < nodes.size(); ++k)
      weights(i, Eigen::Index(k)) = row[Eigen::Index(k)] * std::pow(depths[i] / nodes[k], m);
  }
}

}  // namespace genio
