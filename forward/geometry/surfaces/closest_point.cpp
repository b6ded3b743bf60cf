#include "forward/geometry/surfaces/closest_point.hpp"

#include <Eigen/Dense>
#include <Eigen/StdVector>
#include <limits>
#include <map>
#include <unsupported/Eigen/BVH>

namespace genio {

std::array<double, 3> closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

struct SurfaceDistance::Tree {
  TriangleSurface surface;
  Eigen::KdBVH<double, 3, int> bvh;
  // Normals of faces, edges and vertices; their sign test is exact at the closest feature
  // (Baerentzen & Aanaes 2005).
  std::vector<Vec3> face_normal, vertex_normal;
  std::map<std::pair<int, int>, std::pair<Vec3, int>> edge_normal;  // normal, triangles at it
  std::vector<bool> on_rim;                                         // vertices

  /// A triangle's corners, and a sphere that holds it.
  struct Piece {
    std::array<Vec3, 3> corner;
    Vec3 centre;
    double radius;
  };
  std::vector<Piece> pieces;

  /// The closest triangle and the place on it; `near` is looked at first.
  struct Closest {
    double squared = std::numeric_limits<double>::infinity();
    int triangle = -1;
    std::array<double, 3> weight{};
  };
  Closest closest(const Vec3& p, int near) const;
};

SurfaceDistance::SurfaceDistance(const TriangleSurface& surface) : tree_(std::make_unique<Tree>()) {
  Tree& t = *tree_;
  t.surface = surface;
  t.vertex_normal.assign(surface.vertices.size(), Vec3::Zero());
  t.on_rim.assign(surface.vertices.size(), false);
  std::vector<int> index;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& n = surface.triangles[i];
    const Vec3* v[3] = {&surface.vertices[n[0]], &surface.vertices[n[1]], &surface.vertices[n[2]]};
    const Vec3 normal = (*v[1] - *v[0]).cross(*v[2] - *v[0]).normalized();
    t.face_normal.push_back(normal);
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 3; ++k) {
      box.extend(*v[k]);
      const Vec3 e1 = (*v[(k + 1) % 3] - *v[k]).normalized();
      const Vec3 e2 = (*v[(k + 2) % 3] - *v[k]).normalized();
      t.vertex_normal[n[k]] += std::acos(std::clamp(e1.dot(e2), -1.0, 1.0)) * normal;
      const auto key = std::minmax(n[k], n[(k + 1) % 3]);
      auto& edge = t.edge_normal.try_emplace(key, Vec3::Zero(), 0).first->second;
      edge.first += normal;
      ++edge.second;
    }
    index.push_back(int(i));
    boxes.push_back(box);
    Tree::Piece piece{{*v[0], *v[1], *v[2]}, (*v[0] + *v[1] + *v[2]) / 3, 0};
    for (const Vec3& c : piece.corner)
      piece.radius = std::max(piece.radius, (c - piece.centre).norm());
    t.pieces.push_back(piece);
  }
  for (const auto& [key, edge] : t.edge_normal)
    if (edge.second == 1) t.on_rim[key.first] = t.on_rim[key.second] = true;
  t.bvh.init(index.begin(), index.end(), boxes.begin(), boxes.end());
}

SurfaceDistance::~SurfaceDistance() = default;

SurfaceDistance::Tree::Closest SurfaceDistance::Tree::closest(const Vec3& p, int near) const {
  Closest best;
  const auto look_at = [&](int t) {
    const auto& [corner, centre, radius] = pieces[size_t(t)];
    const double reach = std::sqrt(best.squared) + radius;
    if ((p - centre).squaredNorm() >= reach * reach) return;
    const auto w = closest_on_triangle(p, corner[0], corner[1], corner[2]);
    const double d = (p - w[0] * corner[0] - w[1] * corner[1] - w[2] * corner[2]).squaredNorm();
    if (d < best.squared) best = {d, t, w};
  };
  if (near >= 0) look_at(near);
  std::array<std::pair<double, int>, 128> waiting;  // a tree over 2^63 triangles is no deeper
  size_t count = 0;
  waiting[count++] = {0, bvh.getRootIndex()};
  while (count > 0) {
    const auto [distance, index] = waiting[--count];
    if (distance >= best.squared) continue;
    const int *volume, *volumes, *object, *objects;
    bvh.getChildren(index, volume, volumes, object, objects);
    for (; object != objects; ++object) look_at(*object);
    const size_t first = count;
    for (; volume != volumes; ++volume) {
      const double d = bvh.getVolume(*volume).squaredExteriorDistance(p);
      if (d < best.squared) waiting[count++] = {d, *volume};
    }
    if (count == first + 2 && waiting[first].first < waiting[first + 1].first)
      std::swap(waiting[first], waiting[first + 1]);  // the nearer one next
  }
  return best;
}

SurfaceDistance::Foot SurfaceDistance::foot(const Vec3& p, int& near) const {
  const Tree& t = *tree_;
  const Tree::Closest query = t.closest(p, near);
  near = query.triangle;
  const auto& n = t.surface.triangles[query.triangle];
  const auto& v = t.surface.vertices;
  std::vector<int> touched;
  Foot foot{Vec3::Zero(), t.face_normal[query.triangle], false};
  for (int k = 0; k < 3; ++k) {
    foot.place += query.weight[k] * v[n[k]];
    if (query.weight[k] > 1e-12) touched.push_back(n[k]);
  }
  if (touched.size() == 1) {
    foot.on_rim = t.on_rim[touched[0]];
    foot.normal = t.vertex_normal[touched[0]];
  } else if (touched.size() == 2) {
    const auto& edge = t.edge_normal.at(std::minmax(touched[0], touched[1]));
    foot.on_rim = edge.second == 1;
    foot.normal = edge.first;
  }
  return foot;
}

double SurfaceDistance::operator()(const Vec3& p) const {
  int near = -1;
  return (*this)(p, near);
}

double SurfaceDistance::operator()(const Vec3& p, int& near) const {
  const Foot f = foot(p, near);
  const Vec3 off = p - f.place;
  return f.on_rim || f.normal.dot(off) >= 0 ? off.norm() : -off.norm();
}

}  // namespace genio
