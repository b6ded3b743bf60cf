#include "speaker/decimation/collapsing_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "speaker/solid/edge_list.hpp"
#include "speaker/solid/largest_part.hpp"

namespace genio {
namespace {

constexpr double least_cosine = 0.5;  // between a triangle's normals before and behind
constexpr double least_shape = 0.05;  // 1: of three equal sides

double shape_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / sides : 0;
}

}  // namespace

CollapsingMesh::CollapsingMesh(const TriangleSurface& surface)
    : place_(surface.vertices),
      corner_(surface.triangles),
      alive_(surface.triangles.size(), true),
      around_(surface.vertices.size()),
      kind_(surface.vertices.size(), Kind::inner),
      count_(int(surface.triangles.size())) {
  for (size_t t = 0; t < corner_.size(); ++t)
    for (const int v : corner_[t]) around_[size_t(v)].push_back(int(t));
  std::vector<int> rim_edges(place_.size(), 0);
  const auto sides = sides_by_edge(surface);
  each_edge(sides, [&](auto first, auto last) {
    for (const int v : {first->low, first->high}) {
      if (last - first == 1) ++rim_edges[size_t(v)];
      if (last - first > 2 || (last - first == 2 && first->rises == (first + 1)->rises))
        kind_[size_t(v)] = Kind::locked;
    }
  });
  for (size_t v = 0; v < place_.size(); ++v) {
    if (kind_[v] == Kind::locked) continue;
    // One fan has as many neighbours as triangles, or one more at a rim.
    const size_t fan = around_[v].size() + (rim_edges[v] > 0 ? 1 : 0);
    if (rim_edges[v] > 2 || neighbours(int(v)).size() != fan) kind_[v] = Kind::locked;
    else if (rim_edges[v] > 0) kind_[v] = Kind::rim;
  }
}

bool CollapsingMesh::has(int triangle, int vertex) const {
  const auto& c = corner_[size_t(triangle)];
  return c[0] == vertex || c[1] == vertex || c[2] == vertex;
}

std::vector<int> CollapsingMesh::neighbours(int vertex) const {
  std::vector<int> result;
  for (const int t : around(vertex))
    for (const int v : corners(t))
      if (v != vertex) result.push_back(v);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

bool CollapsingMesh::may_join(int a, int b) const {
  if (kind_[size_t(a)] == Kind::locked || kind_[size_t(b)] == Kind::locked) return false;
  const auto of_a = neighbours(a), of_b = neighbours(b);
  std::vector<int> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                        std::back_inserter(common));
  const auto shared =
      std::count_if(around(a).begin(), around(a).end(), [&](int t) { return has(t, b); });
  if (shared < 1 || shared > 2 || std::ptrdiff_t(common.size()) != shared) return false;
  if (shared == 2 && on_rim(a) && on_rim(b)) return false;
  // A vertex opposite keeps three triangles, or one at a rim.
  for (const int v : common)
    if (around(v).size() < (on_rim(v) ? 2u : 4u)) return false;
  return around(a).size() + around(b).size() > size_t(2 * shared);
}

bool CollapsingMesh::keeps_shape(int a, int b, const Vec3& at) const {
  for (const auto& [t, stays] : affected(a, b)) {
    if (!stays) continue;
    Vec3 before[3], behind[3];
    for (size_t i = 0; i < 3; ++i) {
      const int v = corners(t)[i];
      before[i] = place(v);
      behind[i] = v == a || v == b ? at : before[i];
    }
    const Vec3 n0 = (before[1] - before[0]).cross(before[2] - before[0]);
    const Vec3 n1 = (behind[1] - behind[0]).cross(behind[2] - behind[0]);
    if (!(n0.dot(n1) > least_cosine * n0.norm() * n1.norm())) return false;
    const double shape = shape_of_triangle(behind[0], behind[1], behind[2]);
    if (shape < least_shape && shape < shape_of_triangle(before[0], before[1], before[2]))
      return false;
  }
  return true;
}

std::vector<std::pair<int, bool>> CollapsingMesh::affected(int a, int b) const {
  std::vector<std::pair<int, bool>> result;
  for (const int t : around(a)) result.emplace_back(t, !has(t, b));
  for (const int t : around(b))
    if (!has(t, a)) result.emplace_back(t, true);
  return result;
}

void CollapsingMesh::join(int a, int b, const Vec3& at) {
  for (const int t : around(b)) {
    if (has(t, a)) {
      alive_[size_t(t)] = false;
      --count_;
      for (const int v : corners(t))
        if (v != b) std::erase(around_[size_t(v)], t);
    } else {
      auto& c = corner_[size_t(t)];
      *std::find(c.begin(), c.end(), b) = a;
      around_[size_t(a)].push_back(t);
    }
  }
  around_[size_t(b)].clear();
  if (on_rim(b)) kind_[size_t(a)] = Kind::rim;
  place_[size_t(a)] = at;
}

TriangleSurface CollapsingMesh::surface() const {
  TriangleSurface result{place_, {}};
  for (size_t t = 0; t < corner_.size(); ++t)
    if (alive_[t]) result.triangles.push_back(corner_[t]);
  return without_loose_vertices(result);
}

}  // namespace genio
