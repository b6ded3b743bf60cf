#include "forward/effects/surroundings/airway_pressure.hpp"

#include <Eigen/Geometry>
#include <map>

#include "forward/geometry/quad4.hpp"
#include "forward/tissue/tongue_faces.hpp"

namespace genio {
namespace {

/// Place and tangents of a Gauss point of a face.
struct At {
  Vec3 x = Vec3::Zero(), g1 = Vec3::Zero(), g2 = Vec3::Zero();
  template <class Position>
  At(const Quad& face, const quad4::Point& q, Position position) {
    for (int a = 0; a < 4; ++a) {
      const Vec3 xa = position(face[a]);
      x += q.value[a] * xa, g1 += q.by[a][0] * xa, g2 += q.by[a][1] * xa;
    }
  }
};

/// Of the tongue's free faces those that look up or back.
std::vector<Quad> airway_faces(const HexMesh& mesh, const std::vector<Support>& supports) {
  std::vector<Quad> faces;
  for (const Quad& f : free_faces(mesh, supports)) {
    const Vec3 normal = (mesh.nodes[size_t(f[2])] - mesh.nodes[size_t(f[0])])
                            .cross(mesh.nodes[size_t(f[3])] - mesh.nodes[size_t(f[1])]);
    if (normal.dot(Vec3(0.5, 0, 1)) > 0) faces.push_back(f);
  }
  return faces;
}

}  // namespace

AirwayPressure::AirwayPressure(const HexMesh& mesh, const std::vector<Support>& supports,
                               std::vector<Quad> faces, double pressure)
    : faces_(std::move(faces)),
      centre_(Vec3::Zero()),
      normal_(Vec3::Zero()),
      info_{{{.name = "pressure",
              .unit = "Pa",
              .value = pressure,
              .lower = -1e4,
              .upper = 1e4,
              .load = true}}} {
  std::map<std::pair<int, int>, int> edges;  // met once: the rim
  for (const Quad& face : faces_)
    for (int a = 0; a < 4; ++a) ++edges[std::minmax(face[a], face[(a + 1) % 4])];
  const auto cut = [&](int a) { return supports[size_t(a)] == in_midplane; };
  bool half = false;
  double length = 0;
  for (const auto& [edge, count] : edges) {
    if (count != 1) continue;
    if (cut(edge.first) && cut(edge.second)) {
      half = true;
      continue;
    }
    const Vec3 &u = mesh.nodes[size_t(edge.first)], &v = mesh.nodes[size_t(edge.second)];
    centre_ += (v - u).norm() * 0.5 * (u + v);
    length += (v - u).norm();
  }
  if (length > 0) centre_ /= length;
  for (const Quad& face : faces_)
    for (const auto& q : quad4::gauss_points()) {
      const At at(face, q, [&](int a) { return mesh.nodes[size_t(a)]; });
      normal_ += at.g1.cross(at.g2);
    }
  if (half) centre_[1] = normal_[1] = 0;
  normal_.normalize();
}

double AirwayPressure::energy(const Positions& x, EffectParameters p) const {
  double volume = 0;
  for (const Quad& face : faces_)
    for (const auto& q : quad4::gauss_points()) {
      const At at(face, q, [&](int a) -> Vec3 { return node_position(x, a); });
      volume += (at.x - centre_).dot(normal_) * normal_.dot(at.g1.cross(at.g2));
    }
  return p[0] * volume;
}

void AirwayPressure::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  const Vec3& d = normal_;
  for (const Quad& face : faces_)
    for (const auto& q : quad4::gauss_points()) {
      const At at(face, q, [&](int a) -> Vec3 { return node_position(x, a); });
      const double height = (at.x - centre_).dot(d), area = d.dot(at.g1.cross(at.g2));
      const Vec3 by_g1 = height * at.g2.cross(d), by_g2 = height * d.cross(at.g1);
      for (int a = 0; a < 4; ++a)
        f.segment<3>(3 * face[a]) -=
            p[0] * (q.value[a] * area * d + q.by[a][0] * by_g1 + q.by[a][1] * by_g2);
    }
}

void AirwayPressure::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  const Vec3& d = normal_;
  Mat3 turn;  // turn v = d x v
  turn << 0, -d[2], d[1], d[2], 0, -d[0], -d[1], d[0], 0;
  for (const Quad& face : faces_)
    for (const auto& q : quad4::gauss_points()) {
      const At at(face, q, [&](int a) -> Vec3 { return node_position(x, a); });
      const double height = (at.x - centre_).dot(d);
      const Vec3 c1 = at.g2.cross(d), c2 = d.cross(at.g1);
      const auto slope = [&](int a) -> Vec3 { return q.by[a][0] * c1 + q.by[a][1] * c2; };
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b <= a; ++b) {
          const double twist = q.by[a][0] * q.by[b][1] - q.by[a][1] * q.by[b][0];
          const Mat3 block = q.value[a] * d * slope(b).transpose() +
                             q.value[b] * slope(a) * d.transpose() - height * twist * turn;
          k.add(face[a], face[b], p[0] * block);
        }
    }
}

void AirwayPressure::add_force_derivative(const Positions& x, EffectParameters, int,
                                          Forces& df) const {
  const double one[] = {1.0};
  add_force(x, one, df);  // linear in the pressure
}

EffectKind airway_pressure_kind() {
  return {
      .name = "airway_pressure",
      .make = [](Settings& s, const Anatomy& a) -> Effect {
        const HexMesh& mesh = a.description.mesh;
        const HexMesh& standing = a.standing ? a.standing->mesh : mesh;
        return {.potential = std::make_shared<AirwayPressure>(
                    mesh, a.supports, airway_faces(standing, a.supports), s.take("pressure", 0))};
      },
      .main = "pressure",
      .external = true,
      .belief = {.parameters = {{.parameter = "pressure", .typical = 400}}},
      .sample = {{"pressure", 300}},
      .hidden =
          [](const ChangeDraw&) {
            return change_by_number(
                "airway_pressure",
                {.key = "pressure", .absent = 0, .unit = 100, .first = 2, .most = 40});
          }};
}

}  // namespace genio
