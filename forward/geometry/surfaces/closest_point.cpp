#include "forward/geometry/closest_point.hpp"

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

  struct Query {  // what Eigen's BVMinimize asks for
    using Scalar = double;
    const Tree* tree;
    Vec3 p;
    double best = std::numeric_limits<double>::infinity();
    int triangle = -1;
    std::array<double, 3> weight{};
    double minimumOnVolume(const Eigen::AlignedBox3d& box) const {
      return box.squaredExteriorDistance(p);
    }
    double minimumOnObject(int t) {
      const auto& v = tree->surface.vertices;
      const auto& n = tree->surface.triangles[t];
      const auto w = closest_on_triangle(p, v[n[0]], v[n[1]], v[n[2]]);
      const double d = (p - w[0] * v[n[0]] - w[1] * v[n[1]] - w[2] * v[n[2]]).squaredNorm();
      if (d < best) best = d, triangle = t, weight = w;
      return d;
    }
  };
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
  }
  for (const auto& [key, edge] : t.edge_normal)
    if (edge.second == 1) t.on_rim[key.first] = t.on_rim[key.second] = true;
  t.bvh.init(index.begin(), index.end(), boxes.begin(), boxes.end());
}

SurfaceDistance::~SurfaceDistance() = default;

SurfaceDistance::Foot SurfaceDistance::foot(const Vec3& p) const {
  const Tree& t = *tree_;
  Tree::Query query{&t, p};
  Eigen::BVMinimize(t.bvh, query);
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
  const Foot f = foot(p);
  const Vec3 off = p - f.place;
  return f.on_rim || f.normal.dot(off) >= 0 ? off.norm() : -off.norm();
}

}  // namespace genio
