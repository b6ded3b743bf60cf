#include "forward/effects/muscles/activation_dynamics.hpp"

#include <algorithm>
#include <cmath>

namespace genio {

ActivationDynamics::ActivationDynamics(double rise, double fall)
    : info_{{{.name = "rise", .unit = "s", .value = rise, .lower = 0, .upper = 1},
             {.name = "fall", .unit = "s", .value = fall, .lower = 0, .upper = 1}}} {}

double ActivationDynamics::follow(double excitation, double activation, double dt,
                                  EffectParameters p) const {
  const double tau = excitation > activation ? p[0] : p[1];
  return tau > 0 ? excitation + (activation - excitation) * std::exp(-dt / tau) : excitation;
}

double ActivationDynamics::memory(EffectParameters p) const { return std::max(p[0], p[1]); }

EffectKind activation_dynamics_kind() {
  return {.name = "activation_dynamics",
          .make = [](Settings& s, const Anatomy&) -> Effect {
            const double rise = s.take("rise", 0.015), fall = s.take("fall", 0.05);
            return {.filter = std::make_shared<ActivationDynamics>(rise, fall)};
          },
          .belief = {.parameters = {{.parameter = "rise", .typical = 0.015},
                                    {.parameter = "fall", .typical = 0.05}}}};
}

}  // namespace genio
