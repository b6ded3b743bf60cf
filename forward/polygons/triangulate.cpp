#include "forward/polygons/triangulate.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace genio {
namespace {

using Corners = std::span<const int>;
using Triangles = std::vector<std::array<int, 3>>;

constexpr size_t most_concave = 200;  // corners; cutting ears takes up to their third power

void fan(Corners face, size_t start, Triangles& out) {
  for (size_t k = 1; k + 1 < face.size(); ++k)
    out.push_back(
        {face[start], face[(start + k) % face.size()], face[(start + k + 1) % face.size()]});
}

/// The corner whose angles to its diagonal are more than a straight one; else the first.
size_t inward_corner(const std::vector<Vec3>& points, Corners face) {
  for (size_t i = 0; i < 4; ++i) {
    const Vec3& x = points[size_t(face[i])];
    const auto direction = [&](size_t k) -> Vec3 {
      return (points[size_t(face[(i + k) % 4])] - x).normalized();
    };
    const Vec3 diagonal = direction(2);
    const auto angle = [&](size_t k) {
      return std::acos(std::clamp(direction(k).dot(diagonal), -1.0, 1.0));
    };
    if (angle(1) + angle(3) > std::numbers::pi) return i;
  }
  return 0;
}

/// A face as it is seen along its mean normal.
std::vector<Eigen::Vector2d> flattened(const std::vector<Vec3>& points, Corners face) {
  Vec3 normal = Vec3::Zero();
  for (size_t k = 0; k < face.size(); ++k)
    normal += points[size_t(face[k])].cross(points[size_t(face[(k + 1) % face.size()])]);
  Eigen::Index drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  std::vector<Eigen::Vector2d> flat;
  for (const int k : face) {
    const Vec3& x = points[size_t(k)];
    const double u = x[(drop + 1) % 3], v = x[(drop + 2) % 3];
    flat.emplace_back(normal[drop] < 0 ? Eigen::Vector2d(v, u) : Eigen::Vector2d(u, v));
  }
  return flat;
}

/// Above 0 where a, b, c turn left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool is_convex(const std::vector<Eigen::Vector2d>& flat) {
  const size_t n = flat.size();
  double least = 0, angles = 0;
  for (size_t k = 0; k < n; ++k) {
    const auto &a = flat[k], &b = flat[(k + 1) % n], &c = flat[(k + 2) % n];
    least = std::min(least, turn(a, b, c));
    angles += std::atan2(turn(a, b, c), (b - a).dot(c - b));
  }
  return !(least < 0) && angles < 3 * std::numbers::pi;  // once around
}

/// True where no other corner that is left lies in the triangle at corner `k` of them.
bool is_ear(const std::vector<Eigen::Vector2d>& flat, const std::vector<size_t>& left, size_t k) {
  const size_t n = left.size();
  const auto &a = flat[left[(k + n - 1) % n]], &b = flat[left[k]], &c = flat[left[(k + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  for (size_t other = 2; other + 1 < n; ++other) {
    const auto& p = flat[left[(k + other) % n]];
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

void cut_ears(const std::vector<Eigen::Vector2d>& flat, Corners face, Triangles& out) {
  std::vector<size_t> left(face.size());
  for (size_t k = 0; k < left.size(); ++k) left[k] = k;
  size_t ear = 0;
  while (left.size() > 2) {
    const size_t n = left.size();
    ear %= n;
    for (size_t tried = 1; tried < n && !is_ear(flat, left, ear); ++tried)
      ear = (ear + 1) % n;  // a face that crosses itself may have none
    out.push_back({face[left[(ear + n - 1) % n]], face[left[ear]], face[left[(ear + 1) % n]]});
    left.erase(left.begin() + long(ear));
  }
}

void split(const std::vector<Vec3>& points, Corners face, const std::string& path, Triangles& out) {
  if (face.size() == 3) return fan(face, 0, out);
  if (face.size() == 4) return fan(face, inward_corner(points, face), out);
  const auto flat = flattened(points, face);
  if (is_convex(flat)) return fan(face, face.size() - 1, out);
  if (face.size() > most_concave)
    throw InputError(fmt::format(
        "{}: a face of {} corners is not convex; expected at most {}: split it into triangles",
        path, face.size(), most_concave));
  cut_ears(flat, face, out);
}

}  // namespace

Triangles triangulated(const Polygons& polygons, const std::string& path) {
  Triangles result;
  size_t first = 0;
  for (const size_t end : polygons.ends) {
    split(polygons.points, Corners(polygons.corners).subspan(first, end - first), path, result);
    first = end;
  }
  return result;
}

}  // namespace genio
