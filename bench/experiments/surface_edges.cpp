#include "bench/experiments/surface_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace genio::bench {
namespace {

/// Angles between neighbouring faces of the tongue's own surface [deg].
std::vector<double> edge_angles(const Model& m, const Positions& x) {
  std::map<std::pair<int, int>, std::vector<Vec3>> edges;
  for (const Quad& f : m.surface) {
    if (std::any_of(f.begin(), f.end(),
                    [&](int n) { return m.supports[size_t(n)] != Support::free; }))
      continue;
    const Vec3 normal = Vec3(node_position(x, f[2]) - node_position(x, f[0]))
                            .cross(Vec3(node_position(x, f[3]) - node_position(x, f[1])))
                            .normalized();
    for (size_t i = 0; i < 4; ++i) edges[std::minmax(f[i], f[(i + 1) % 4])].push_back(normal);
  }
  std::vector<double> angles;
  for (const auto& [edge, normals] : edges)
    if (normals.size() == 2)
      angles.push_back(180 / M_PI * std::acos(std::clamp(normals[0].dot(normals[1]), -1.0, 1.0)));
  return angles;
}

}  // namespace

EdgeSharpness sharpness(const Model& m, const Positions& x) {
  const auto before = edge_angles(m, m.rest);
  auto change = edge_angles(m, x);
  for (size_t i = 0; i < change.size(); ++i) change[i] -= before[i];
  std::sort(change.begin(), change.end());
  return {.largest = change.back(), .p99 = change[change.size() * 99 / 100]};
}

}  // namespace genio::bench
