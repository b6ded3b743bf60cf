#include "forward/effects/tissue/viscosity.hpp"

namespace genio {

Viscosity::Viscosity(const NodeMatrix& mass, double alpha, double beta)
    : mass_(mass),
      info_{{{.name = "alpha", .unit = "1/s", .value = alpha, .lower = 0, .upper = 1e4},
             {.name = "beta", .unit = "s", .value = beta, .lower = 0, .upper = 10}}} {}

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

EffectKind viscosity_kind() {
  return {.name = "viscosity",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const double alpha = s.take("alpha", 40), beta = s.take("beta", 0.03);
            return {.dissipation = std::make_shared<Viscosity>(a.mass, alpha, beta)};
          },
          .belief = {.parameters = {{.parameter = "alpha", .typical = 40},
                                    {.parameter = "beta", .typical = 0.03}}}};
}

}  // namespace genio
