#include "speaker/solid/largest_part.hpp"

#include <Eigen/Geometry>

#include "speaker/solid/parts.hpp"

namespace genio {

TriangleSurface largest_part(const TriangleSurface& surface) {
  const auto part = part_of_triangles(surface, sides_by_edge(surface));
  std::vector<double> area;
  for (size_t t = 0; t < part.size(); ++t) {
    if (size_t(part[t]) >= area.size()) area.resize(size_t(part[t]) + 1, 0);
    const auto& n = surface.triangles[t];
    const Vec3& a = surface.vertices[size_t(n[0])];
    area[size_t(part[t])] +=
        (surface.vertices[size_t(n[1])] - a).cross(surface.vertices[size_t(n[2])] - a).norm();
  }
  const int largest = int(std::max_element(area.begin(), area.end()) - area.begin());
  TriangleSurface kept{surface.vertices, {}};
  for (size_t t = 0; t < part.size(); ++t)
    if (part[t] == largest) kept.triangles.push_back(surface.triangles[t]);
  return without_loose_vertices(kept);
}

TriangleSurface without_loose_vertices(const TriangleSurface& surface) {
  TriangleSurface result;
  std::vector<int> number(surface.vertices.size(), -1);
  for (auto t : surface.triangles) {
    for (int& v : t) {
      int& n = number[size_t(v)];
      if (n < 0) {
        n = int(result.vertices.size());
        result.vertices.push_back(surface.vertices[size_t(v)]);
      }
      v = n;
    }
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace genio
