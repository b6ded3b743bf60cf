#include "forward/effects/gravity.hpp"

#include <Eigen/Dense>

#include "forward/hex8.hpp"

namespace genio {

Gravity::Gravity(const HexMesh& mesh, double density, const Vec3& acceleration)
    : mass_(mesh.nodes.size(), 0.0) {
  for (const auto& element : mesh.elements)
    for (const auto& xi : hex8::gauss_points()) {
      const auto d = hex8::derivatives(xi);
      const auto n = hex8::values(xi);
      const auto corner = [&](int a) -> const Vec3& { return mesh.nodes[element[a]]; };
      const double volume = hex8::jacobian(corner, d).determinant();
      for (int a = 0; a < 8; ++a) mass_[element[a]] += density * n[a] * volume;
    }
  const char* axis[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) info_[i] = {axis[i], "m/s^2", acceleration[i], -20, 20, 0, true};
}

double Gravity::energy(const Positions& x, EffectParameters p) const {
  const Vec3 g(p[0], p[1], p[2]);
  double e = 0;
  for (size_t a = 0; a < mass_.size(); ++a) e -= mass_[a] * g.dot(node_position(x, int(a)));
  return e;
}

void Gravity::add_force(const Positions&, EffectParameters p, Forces& f) const {
  const Vec3 g(p[0], p[1], p[2]);
  for (size_t a = 0; a < mass_.size(); ++a) f.segment<3>(3 * a) += mass_[a] * g;
}

void Gravity::add_force_derivative(const Positions&, EffectParameters, int k, Forces& df) const {
  for (size_t a = 0; a < mass_.size(); ++a) df[3 * a + k] += mass_[a];
}

}  // namespace genio
