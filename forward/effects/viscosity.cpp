#include "forward/effects/viscosity.hpp"

namespace genio {
namespace {

/// The elasticity's constants, scaled: its stiffness is linear in them.
std::array<double, 3> constants(EffectParameters p, double scale) {
  return {scale * p[2], scale * p[3], scale * p[4]};
}

}  // namespace

Viscosity::Viscosity(NodeMatrix mass, std::shared_ptr<const Elasticity> elasticity, double alpha,
                     double beta)
    : mass_(std::move(mass)),
      elasticity_(std::move(elasticity)),
      info_{{{"alpha", "1/s", alpha, 0, 1e4, 0}, {"beta", "s", beta, 0, 10, 0}}} {}

double Viscosity::dissipation(const Positions& x, const Vector& v, EffectParameters p) const {
  Forces f = Forces::Zero(x.size());
  add_viscous_force(x, v, p, f);
  return -0.5 * f.dot(v);
}

void Viscosity::add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                                  Forces& f) const {
  if (p[0] != 0) f -= p[0] * multiply(mass_, v);
  if (p[1] != 0) elasticity_->add_stiffness_product(x, v, constants(p, -p[1]), f);
}

void Viscosity::add_damping(const Positions& x, const Vector&, EffectParameters p,
                            Stiffness& c) const {
  if (p[0] != 0) c.add(mass_, p[0]);
  if (p[1] != 0) elasticity_->add_stiffness(x, constants(p, p[1]), c);
}

void Viscosity::add_viscous_force_derivative(const Positions& x, const Vector& v,
                                             EffectParameters p, int k, Forces& df) const {
  if (k == 0) {
    df -= multiply(mass_, v);
    return;
  }
  std::array<double, 3> c = constants(p, -1);
  if (k > 1) c = {}, c[size_t(k - 2)] = -p[1];
  elasticity_->add_stiffness_product(x, v, c, df);
}

}  // namespace genio
