#include "forward/effects/dissipation.hpp"

namespace genio {

double Dissipation::dissipation(const Positions& x, const Vector& v, EffectParameters p) const {
  Forces f = Forces::Zero(x.size());
  add_viscous_force(x, v, p, f);
  return -0.5 * f.dot(v);
}

void Dissipation::add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                                          const Matrix& along, Stiffness&, Matrix& df) const {
  constexpr double longest = 1e-7;  // displacement of a node [m]
  const auto viscous = [&](const Positions& at) {
    Forces f = Forces::Zero(at.size());
    add_viscous_force(at, v, p, f);
    return f;
  };
  if (viscous(x).isZero(0)) return;
  for (Eigen::Index c = 0; c < along.cols(); ++c) {
    const double size = along.col(c).cwiseAbs().maxCoeff();
    if (size == 0) continue;
    const double h = longest / size;
    df.col(c) += (viscous(x + h * along.col(c)) - viscous(x - h * along.col(c))) / (2 * h);
  }
}

}  // namespace genio
