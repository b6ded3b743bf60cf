#pragma once
#include <array>

#include "forward/effects/kind.hpp"

namespace genio {

/// Muscles answer their commands late: da/dt = (u - a) / tau with the excitation u that is
/// commanded and the activation a that pulls, tau = rise while u > a and fall otherwise
/// (first-order activation dynamics as in Wilhelms-Tricarico 1995). simulate() passes the commands
/// through it. Parameters: rise, fall [s].
class ActivationDynamics final : public CommandFilter {
 public:
  ActivationDynamics(double rise, double fall);

  std::string_view name() const override { return "activation_dynamics"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double follow(double excitation, double activation, double dt, EffectParameters p) const override;
  double memory(EffectParameters p) const override;

 private:
  std::array<ParameterInfo, 2> info_;
};

EffectKind activation_dynamics_kind();

}  // namespace genio
