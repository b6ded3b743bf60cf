#include "forward/tissue/fibre_field.hpp"

#include <Eigen/Dense>

#include "forward/geometry/hex8.hpp"

namespace genio {

FibreSample fibre_sample(const HexMesh& mesh, int element, int q, const Vec3& direction,
                         double share) {
  const auto& nodes = mesh.elements[element];
  const auto d = hex8::derivatives(hex8::gauss_points()[q]);
  const Mat3 jacobian =
      hex8::jacobian([&](int a) -> const Vec3& { return mesh.nodes[nodes[a]]; }, d);
  const Eigen::Matrix<double, 8, 1> rate = d * (jacobian.inverse() * direction);
  FibreSample s{nodes, {}, share * jacobian.determinant()};
  for (int a = 0; a < 8; ++a) s.rate[a] = rate[a];
  return s;
}

Vec3 gauss_point(const HexMesh& mesh, int element, int q) {
  const auto n = hex8::values(hex8::gauss_points()[q]);
  Vec3 x = Vec3::Zero();
  for (int a = 0; a < 8; ++a) x += n[a] * mesh.nodes[mesh.elements[element][a]];
  return x;
}

}  // namespace genio
