#include "forward/effects/tissue/viscosity.hpp"

namespace genio {

Viscosity::Viscosity(NodeMatrix mass, double alpha, double beta)
    : mass_(std::move(mass)),
      info_{{{"alpha", "1/s", alpha, 0, 1e4, 0, false, false, 40},
             {"beta", "s", beta, 0, 10, 0, false, false, 0.03}}} {}

void Viscosity::add_viscous_force(const Positions&, const Vector& v, EffectParameters p,
                                  Forces& f) const {
  if (p[0] != 0) f -= p[0] * multiply(mass_, v);
}

void Viscosity::add_damping(const Positions&, const Vector&, EffectParameters p,
                            Stiffness& c) const {
  if (p[0] != 0) c.add(mass_, p[0]);
}

void Viscosity::add_viscous_force_derivative(const Positions&, const Vector& v, EffectParameters,
                                             int k, Forces& df) const {
  if (k == 0) df -= multiply(mass_, v);
}

}  // namespace genio
