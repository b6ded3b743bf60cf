#include "forward/effects/tissue/mucosa_layer.hpp"

#include <Eigen/Dense>

#include "forward/geometry/quad4.hpp"
#include "forward/tissue/tongue_faces.hpp"
#include "forward/tissue/yeoh.hpp"

namespace genio {

using Metric = Eigen::Matrix2d;

struct MucosaLayer::State {
  Eigen::Matrix<double, 3, 2> g;     // tangents
  Eigen::Matrix<double, 3, 2> dual;  // their dual basis in the plane
  Metric dual_metric;                // a^(ab)
  Vec3 normal;
  double shrink;     // 1 / det C
  double invariant;  // I - 3

  /// dI/dg_a: column a.
  Eigen::Matrix<double, 3, 2> slope(const Point& p) const {
    return 2 * g * p.inverse - 2 * shrink * dual;
  }
  /// d2I/dg_a dg_b.
  Mat3 curvature(const Point& p, int a, int b) const {
    return 2 * p.inverse(a, b) * Mat3::Identity() +
           shrink * (4 * dual.col(a) * dual.col(b).transpose() +
                     2 * dual.col(b) * dual.col(a).transpose() -
                     2 * dual_metric(a, b) * normal * normal.transpose());
  }
};

MucosaLayer::State MucosaLayer::state(const Point& p, const Positions& x) {
  State s;
  s.g.setZero();
  for (int n = 0; n < 4; ++n)
    for (int a = 0; a < 2; ++a) s.g.col(a) += p.by[n][a] * node_position(x, p.node[n]);
  const Metric metric = s.g.transpose() * s.g;
  s.dual_metric = metric.inverse();
  s.dual = s.g * s.dual_metric;
  s.normal = Vec3(s.g.col(0)).cross(Vec3(s.g.col(1))).normalized();
  s.shrink = p.density / metric.determinant();
  s.invariant = (p.inverse * metric).trace() + s.shrink - 3;
  return s;
}

MucosaLayer::MucosaLayer(const HexMesh& mesh, const std::vector<Quad>& faces, double a10,
                         double a20, double thickness)
    : info_{{{.name = "a10", .unit = "Pa", .value = a10, .lower = 0, .upper = 1e7},
             {.name = "a20", .unit = "Pa", .value = a20, .lower = 0, .upper = 1e7},
             {.name = "thickness", .unit = "m", .value = thickness, .lower = 0, .upper = 1e-2}}} {
  for (const Quad& face : faces)
    for (const auto& gauss : quad4::gauss_points()) {
      Eigen::Matrix<double, 3, 2> g = Eigen::Matrix<double, 3, 2>::Zero();
      for (int n = 0; n < 4; ++n)
        for (int a = 0; a < 2; ++a) g.col(a) += gauss.by[n][a] * mesh.nodes[size_t(face[n])];
      const Metric metric = g.transpose() * g;
      points_.push_back({face, gauss.by, metric.inverse(), metric.determinant(),
                         std::sqrt(metric.determinant())});
    }
}

double MucosaLayer::energy(const Positions& x, EffectParameters p) const {
  const Yeoh<double> law{p[0], p[1], 0};
  double e = 0;
  for (const Point& point : points_)
    e += p[2] * point.area * law.energy_density(state(point, x).invariant);
  return e;
}

void MucosaLayer::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  const Yeoh<double> law{p[0], p[1], 0};
  for (const Point& point : points_) {
    const State s = state(point, x);
    const auto pull = (p[2] * point.area * law.slope(s.invariant) * s.slope(point)).eval();
    for (int n = 0; n < 4; ++n)
      for (int a = 0; a < 2; ++a) f.segment<3>(3 * point.node[n]) -= point.by[n][a] * pull.col(a);
  }
}

void MucosaLayer::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  const Yeoh<double> law{p[0], p[1], 0};
  for (const Point& point : points_) {
    const State s = state(point, x);
    const double scale = p[2] * point.area;
    const auto slope = s.slope(point);
    Mat3 block[2][2];
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        block[a][b] =
            scale * (law.slope(s.invariant) * s.curvature(point, a, b) +
                     law.curvature(s.invariant) * slope.col(a) * slope.col(b).transpose());
    for (int m = 0; m < 4; ++m)
      for (int n = 0; n <= m; ++n) {
        Mat3 sum = Mat3::Zero();
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b) sum += point.by[m][a] * point.by[n][b] * block[a][b];
        k.add(point.node[m], point.node[n], sum);
      }
  }
}

void MucosaLayer::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                       Forces& df) const {
  const double per_unit[3] = {k == 1   ? 0
                              : k == 0 ? 1
                                       : p[0],
                              k == 0   ? 0
                              : k == 1 ? 1
                                       : p[1],
                              k == 2 ? 1 : p[2]};
  add_force(x, per_unit, df);  // linear in the constants and in the thickness
}

EffectKind mucosa_layer_kind() {
  return {.name = "mucosa_layer",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const double a10 = s.take("a10", 0), a20 = s.take("a20", 0),
                         thickness = s.take("thickness", 1e-3);
            const HexMesh& mesh = a.description.mesh;
            return {.potential = std::make_shared<MucosaLayer>(mesh, free_faces(mesh, a.supports),
                                                               a10, a20, thickness)};
          },
          .belief = {.parameters = {{.parameter = "a10", .typical = 1e4}}},
          .sample = {{"a10", 500}, {"a20", 300}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_number(
                    "mucosa_layer",
                    {.key = "a10", .absent = 0, .unit = 1e3, .first = 8, .most = 500});
              }};
}

}  // namespace genio
