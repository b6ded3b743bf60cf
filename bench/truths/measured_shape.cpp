#include "bench/truths/measured_shape.hpp"

#include <algorithm>

#include "forward/base/thin.hpp"
#include "forward/tissue/tongue_faces.hpp"
#include "inverse/target/facets.hpp"

namespace genio::bench {
namespace {

constexpr int curve_points = 40;
constexpr size_t slice_points = 20, surface_points = 120;
constexpr double upward = 0.2;  // of a facet's normal, where a device above or below sees it
constexpr std::array slices_at = {0.35, 0.6};  // of the way from tip to root along x

/// Facets of the tongue's own surface that look up.
std::vector<std::array<Vec3, 3>> upper_facets(const Model& tongue, const Positions& x) {
  std::vector<std::array<Vec3, 3>> upper;
  for (const Facet& f : facets(free_faces(tongue.mesh, tongue.supports))) {
    const auto corners = corners_of(f, x);
    const auto& [a, b, c] = corners;
    if ((b - a).cross(c - a).normalized()[2] > upward) upper.push_back(corners);
  }
  return upper;
}

/// Where a plane of constant x cuts the facets, from left to right.
std::vector<Vec3> cut(const std::vector<std::array<Vec3, 3>>& facets, double at) {
  std::vector<Vec3> points;
  for (const auto& corners : facets)
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 &p = corners[k], &q = corners[(k + 1) % 3];
      if ((p[0] < at) == (q[0] < at)) continue;
      points.push_back(p + (at - p[0]) / (q[0] - p[0]) * (q - p));
    }
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a[1] < b[1]; });
  return points;
}

std::vector<SurfacePoint> slice_points_of(const std::vector<std::array<Vec3, 3>>& facets,
                                          double noise) {
  double front = 1e9, back = -1e9;
  for (const auto& corners : facets)
    for (const Vec3& p : corners) front = std::min(front, p[0]), back = std::max(back, p[0]);
  std::vector<SurfacePoint> points;
  int slice = 0;
  for (double part : slices_at) {
    ++slice;
    for (const Vec3& p : thin(cut(facets, front + part * (back - front)), slice_points))
      points.push_back({p, noise, slice});
  }
  return points;
}

}  // namespace

const char* to_string(Measurement what) {
  switch (what) {
    case Measurement::curve:
      return "curve";
    case Measurement::slices:
      return "slices";
    case Measurement::surface:
      return "surface";
  }
  return "";
}

Target measured_shape(const Model& tongue, const Positions& x, Measurement what, double noise,
                      std::mt19937& random) {
  std::normal_distribution<double> normal(0, noise);
  Target target;
  const auto upper = upper_facets(tongue, x);
  if (what != Measurement::surface)
    target.curve = curve_target(tongue, x, curve_points, noise).curve;
  if (what == Measurement::slices) target.surface = slice_points_of(upper, noise);
  if (what == Measurement::surface) {
    std::vector<SurfacePoint> all;
    for (const auto& [a, b, c] : upper) all.push_back({(a + b + c) / 3, noise, 0});
    std::shuffle(all.begin(), all.end(), random);
    target.surface = thin(all, surface_points);
  }
  for (auto& p : target.curve) p.position += Vec2(normal(random), normal(random));
  for (auto& p : target.surface) p.position += Vec3(normal(random), normal(random), normal(random));
  return target;
}

}  // namespace genio::bench
