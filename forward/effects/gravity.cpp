#include "forward/effects/gravity.hpp"

#include <Eigen/Dense>

namespace genio {

Gravity::Gravity(const NodeMatrix& mass, const Vec3& acceleration)
    : mass_(mass * Vector::Ones(mass.cols())) {
  const char* axis[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) info_[i] = {axis[i], "m/s^2", acceleration[i], -20, 20, 0, true};
}

double Gravity::energy(const Positions& x, EffectParameters p) const {
  const Vec3 g(p[0], p[1], p[2]);
  double e = 0;
  for (Eigen::Index a = 0; a < mass_.size(); ++a) e -= mass_[a] * g.dot(node_position(x, int(a)));
  return e;
}

void Gravity::add_force(const Positions&, EffectParameters p, Forces& f) const {
  const Vec3 g(p[0], p[1], p[2]);
  for (Eigen::Index a = 0; a < mass_.size(); ++a) f.segment<3>(3 * a) += mass_[a] * g;
}

void Gravity::add_force_derivative(const Positions&, EffectParameters, int k, Forces& df) const {
  for (Eigen::Index a = 0; a < mass_.size(); ++a) df[3 * a + k] += mass_[a];
}

}  // namespace genio
