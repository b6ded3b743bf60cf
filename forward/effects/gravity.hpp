#pragma once
#include <array>

#include "forward/effects/effect.hpp"
#include "forward/mesh.hpp"

namespace genio {

/// Weight of the tissue: E = -sum_a m_a g . x_a, with the row sums m_a of the
/// mass matrix. Parameters x, y, z: the
/// acceleration g [m/s^2], absent at 0.
class Gravity final : public Effect {
 public:
  Gravity(const NodeMatrix& mass, const Vec3& acceleration);

  std::string_view name() const override { return "gravity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions&, EffectParameters, Stiffness&) const override {}
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  Vector mass_;
  std::array<ParameterInfo, 3> info_;
};

}  // namespace genio
