#include "inverse/target/facets.hpp"

#include <cmath>
#include <limits>

#include "forward/geometry/surfaces/closest_point.hpp"

namespace genio {

std::vector<Facet> facets(const std::vector<Quad>& surface) {
  std::vector<Facet> result;
  for (const Quad& q : surface)
    for (size_t k = 0; k < 4; ++k)
      result.push_back({q[k], q[(k + 1) % 4], q[(k + 2) % 4], q[(k + 3) % 4]});
  return result;
}

std::array<Vec3, 3> corners_of(const Facet& f, const Positions& x) {
  const Vec3 a = node_position(x, f[0]), b = node_position(x, f[1]);
  return {a, b, 0.25 * (a + b + node_position(x, f[2]) + node_position(x, f[3]))};
}

std::array<double, 4> node_shares(const std::array<double, 3>& w) {
  const double each = 0.25 * w[2];
  return {w[0] + each, w[1] + each, each, each};
}

FacetSurface::FacetSurface(const std::vector<Facet>& facets, const Positions& x) : facets_(facets) {
  for (const Facet& f : facets) {
    corners_.push_back(corners_of(f, x));
    const auto& [a, b, c] = corners_.back();
    middle_.push_back((a + b + c) / 3);
    double square = 0;
    for (const Vec3& corner : corners_.back())
      square = std::max(square, (corner - middle_.back()).squaredNorm());
    radius_.push_back(std::sqrt(square));
  }
}

Foot FacetSurface::foot(size_t facet, const Vec3& q) const {
  const auto& [a, b, c] = corners_[facet];
  const auto w = closest_on_triangle(q, a, b, c);
  const Vec3 f = w[0] * a + w[1] * b + w[2] * c;
  return {w, f, (q - f).squaredNorm()};
}

bool FacetSurface::beyond(size_t facet, const Vec3& q, double distance) const {
  const double reach = distance + radius_[facet];
  return (q - middle_[facet]).squaredNorm() > reach * reach;
}

size_t FacetSurface::nearest(const Vec3& q) const {
  size_t best = 0;
  double square = std::numeric_limits<double>::infinity(), distance = square;
  for (size_t t = 0; t < facets_.size(); ++t) {
    if (beyond(t, q, distance)) continue;
    if (const double s = foot(t, q).square; s < square)
      square = s, distance = std::sqrt(s), best = t;
  }
  return best;
}

std::vector<size_t> FacetSurface::within(const Vec3& q, double distance) const {
  std::vector<size_t> result;
  for (size_t t = 0; t < facets_.size(); ++t)
    if (!beyond(t, q, distance)) result.push_back(t);
  return result;
}

}  // namespace genio
