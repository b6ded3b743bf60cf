#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// Muscles pull less the faster they shorten, in dynamics only (Hill 1938).
///
/// A segment's tension is multiplied by 1 + strength (f(u) - 1), u = (dL/dt) / (max_velocity
/// L_rest): f = (1 + u) / (1 - 4 u) while it shortens, none below u = -1; f = 1.8 - 0.8 / (1 + 6.25
/// u) while it lengthens: Hill's hyperbola and a branch that continues its slope to 1.8 times the
/// force. Parameters: strength (0 to 1), max_velocity [1/s].
class ForceVelocity final : public Dissipation {
 public:
  ForceVelocity(std::vector<Muscle> muscles, double strength, double max_velocity);

  std::string_view name() const override { return "force_velocity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<ParameterName> borrows() const override;
  double dissipation(const Positions& x, const Vector& v, EffectParameters p) const override;
  void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                         Forces& f) const override;
  void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                   Stiffness& c) const override;
  void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p, int k,
                                    Forces& df) const override;

 private:
  std::vector<Muscle> muscles_;
  std::array<ParameterInfo, 2> info_;
};

EffectKind force_velocity_kind();

}  // namespace genio
