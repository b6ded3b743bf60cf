#pragma once
#include <array>

#include "forward/effects/effect.hpp"

namespace genio {

/// Weight of the tissue: E = -sum_a m_a g . x_a, with the mass of each element shared over its
/// nodes by its shape functions. Parameters x, y, z: the acceleration g [m/s^2], absent at 0.
class Gravity final : public Effect {
 public:
  /// `density` in kg/m^3.
  Gravity(const HexMesh& mesh, double density, const Vec3& acceleration);

  std::string_view name() const override { return "gravity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions&, EffectParameters, Stiffness&) const override {}
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  std::vector<double> mass_;  // [kg]
  std::array<ParameterInfo, 3> info_;
};

}  // namespace genio
