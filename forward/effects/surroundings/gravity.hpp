#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// Weight of the tissue: E = -sum_a m_a g . x_a, with the row sums m_a of the mass matrix and g the
/// acceleration in the frame of the head. Parameters x, y, z: the acceleration for an upright head
/// [m/s^2], absent at 0; pitch: how far the head is tilted backwards [deg], 90 where the speaker
/// lies on the back.
class Gravity final : public Potential {
 public:
  Gravity(const NodeMatrix& mass, const Vec3& acceleration, double pitch = 0);

  std::string_view name() const override { return "gravity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions&, EffectParameters, Stiffness&) const override {}
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  void add_weight(const Vec3& acceleration, Forces& f) const;

  Vector mass_;
  std::array<ParameterInfo, 4> info_;
};

EffectKind gravity_kind();

}  // namespace genio
