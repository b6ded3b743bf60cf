#include "forward/geometry/surfaces/bone_distance.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "forward/geometry/joined_sets.hpp"

namespace genio {
namespace {

constexpr double bone_depth = 8e-3;  // behind a sheet: teeth and lip, palate and nose [m]

/// A representative vertex of each vertex's connected part.
std::vector<int> parts(const TriangleSurface& surface) {
  JoinedSets sets(surface.vertices.size());
  for (const auto& t : surface.triangles) sets.join(t[1], t[0]), sets.join(t[2], t[0]);
  std::vector<int> part(surface.vertices.size());
  for (size_t v = 0; v < part.size(); ++v) part[v] = sets.set(int(v));
  return part;
}

/// Edges that one triangle has, in its direction.
std::vector<std::pair<int, int>> rim(const TriangleSurface& surface) {
  std::map<std::pair<int, int>, std::pair<std::pair<int, int>, int>> edges;
  for (const auto& t : surface.triangles)
    for (size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      auto& edge = edges[std::minmax(a, b)];
      edge.first = {a, b}, ++edge.second;
    }
  std::vector<std::pair<int, int>> result;
  for (const auto& [key, edge] : edges)
    if (edge.second == 1) result.push_back(edge.first);
  return result;
}

/// How sure the tongue is that it lies on the side of the normals: near points know it best.
double vote(const TriangleSurface& part, const std::vector<Vec3>& inside_points) {
  const SurfaceDistance distance(part);
  double sum = 0;
  int near = -1;
  for (const Vec3& p : inside_points) {
    const double d = distance(p, near);
    sum += d / (d * d + 1e-6);
  }
  return sum;
}

}  // namespace

TriangleSurface facing_tongue(TriangleSurface surface, const std::vector<Vec3>& inside_points) {
  const auto part = parts(surface);
  std::map<int, TriangleSurface> by_part;
  for (const auto& t : surface.triangles) by_part[part[size_t(t[0])]].triangles.push_back(t);
  for (auto& [root, only] : by_part) {
    only.vertices = surface.vertices;
    if (vote(only, inside_points) >= 0) continue;
    for (auto& t : surface.triangles)
      if (part[size_t(t[0])] == root) std::swap(t[1], t[2]);
  }
  return surface;
}

BoneDistance::BoneDistance(const TriangleSurface& surface) : face_(surface) {
  const auto part = parts(surface);
  std::vector<bool> with_rim(surface.vertices.size(), false);
  for (const auto& [a, b] : rim(surface)) {
    rim_.emplace_back(surface.vertices[size_t(a)], surface.vertices[size_t(b)]);
    with_rim[size_t(part[size_t(a)])] = true;
  }
  for (const auto& t : surface.triangles) open_.push_back(with_rim[size_t(part[size_t(t[0])])]);
}

double BoneDistance::depth(const Vec3& place) const {
  double least = bone_depth * bone_depth;
  for (const auto& [a, b] : rim_) {
    const Vec3 along = b - a, off = place - a;
    const double t = std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (off - t * along).squaredNorm());
  }
  return std::sqrt(least);
}

double BoneDistance::operator()(const Vec3& p, int& near) const {
  const auto foot = face_.foot(p, near);
  return from(foot, p, near);
}

double BoneDistance::from(const SurfaceDistance::Foot& foot, const Vec3& p, int near) const {
  const Vec3 off = p - foot.place;
  const double far = off.norm();
  const double behind = -foot.normal.normalized().dot(off);
  if (behind <= 0) return far;
  if (!open_[size_t(near)]) return -far;
  // The bone's two faces meet at 45 degrees at the rim.
  if (foot.on_rim) {
    const double beside = std::sqrt(std::max(0.0, far * far - behind * behind));
    return behind > beside ? (behind + beside) * std::sqrt(0.5) : far;
  }
  return std::max(-far, (far - depth(foot.place)) * std::sqrt(0.5));
}

}  // namespace genio
