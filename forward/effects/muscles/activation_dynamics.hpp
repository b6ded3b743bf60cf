#pragma once
#include <array>

#include "forward/effects/effect.hpp"

namespace genio {

/// Muscles answer their commands late: da/dt = (u - a) / tau with the excitation u that is
/// commanded and the activation a that pulls, tau = rise while u > a and fall otherwise
/// (first-order activation dynamics as in Wilhelms-Tricarico 1995). No force of its own: simulate()
/// passes the commands through it. Parameters: rise, fall [s].
class ActivationDynamics final : public Effect {
 public:
  ActivationDynamics(double rise, double fall)
      : info_{{{"rise", "s", rise, 0, 1, 0, false, false, 0.015},
               {"fall", "s", fall, 0, 1, 0, false, false, 0.05}}} {}

  std::string_view name() const override { return "activation_dynamics"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions&, EffectParameters) const override { return 0; }
  void add_force(const Positions&, EffectParameters, Forces&) const override {}
  void add_stiffness(const Positions&, EffectParameters, Stiffness&) const override {}
  void add_force_derivative(const Positions&, EffectParameters, int, Forces&) const override {}

 private:
  std::array<ParameterInfo, 2> info_;
};

}  // namespace genio
