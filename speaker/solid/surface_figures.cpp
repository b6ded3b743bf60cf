#include "speaker/solid/surface_figures.hpp"

#include <Eigen/Geometry>

#include "forward/geometry/joined_sets.hpp"
#include "speaker/solid/parts.hpp"

namespace genio {
namespace {

/// True where the corners at every vertex are one fan. Two corners are neighbours where their
/// triangles share an edge at the vertex.
bool one_fan_each(const TriangleSurface& surface, const std::vector<TriangleSide>& sides) {
  const auto corner = [&](int triangle, int vertex) {
    const auto& t = surface.triangles[size_t(triangle)];
    return 3 * triangle + int(std::find(t.begin(), t.end(), vertex) - t.begin());
  };
  JoinedSets fans(3 * surface.triangles.size());
  each_edge(sides, [&](auto first, auto last) {
    for (auto s = first + 1; s != last; ++s)
      for (const int v : {first->low, first->high})
        fans.join(corner(s->triangle, v), corner(first->triangle, v));
  });
  std::vector<int> fan_at(surface.vertices.size(), -1);
  for (size_t t = 0; t < surface.triangles.size(); ++t)
    for (size_t i = 0; i < 3; ++i) {
      int& at = fan_at[size_t(surface.triangles[t][i])];
      const int fan = fans.set(int(3 * t + i));
      if (at >= 0 && at != fan) return false;
      at = fan;
    }
  return true;
}

}  // namespace

double enclosed_volume(const TriangleSurface& surface) {
  if (surface.triangles.empty()) return 0;
  // About a point of the surface, so that a surface far from the origin loses no digits.
  const Vec3 origin = surface.vertices[size_t(surface.triangles[0][0])];
  double sum = 0;
  for (const auto& t : surface.triangles) {
    const Vec3 a = surface.vertices[size_t(t[0])] - origin;
    const Vec3 b = surface.vertices[size_t(t[1])] - origin;
    sum += a.cross(b).dot(surface.vertices[size_t(t[2])] - origin);
  }
  return sum / 6;
}

SurfaceFigures surface_figures(const TriangleSurface& surface) {
  const auto sides = sides_by_edge(surface);
  SurfaceFigures f{int(surface.triangles.size()), 0, 0, true, true, 0, 0, enclosed_volume(surface)};
  int edges = 0;
  each_edge(sides, [&](auto first, auto last) {
    ++edges;
    const auto count = last - first;
    f.closed = f.closed && count >= 2;
    f.manifold = f.manifold && (count == 1 || (count == 2 && first->rises != (first + 1)->rises));
  });
  std::vector<bool> used(surface.vertices.size(), false);
  for (const auto& t : surface.triangles) {
    for (const int v : t) used[size_t(v)] = true;
    const Vec3& a = surface.vertices[size_t(t[0])];
    f.area +=
        0.5 * (surface.vertices[size_t(t[1])] - a).cross(surface.vertices[size_t(t[2])] - a).norm();
  }
  f.vertices = int(std::count(used.begin(), used.end(), true));
  f.manifold = f.manifold && one_fan_each(surface, sides);
  f.euler = f.vertices - edges + f.triangles;
  for (const int part : part_of_triangles(surface, sides)) f.parts = std::max(f.parts, part + 1);
  return f;
}

}  // namespace genio
