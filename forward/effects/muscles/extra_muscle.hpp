#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/tissue/fibre_field.hpp"

namespace genio {

/// A muscle that the model lacks: a straight bundle inside the tissue.
///
/// E = (force / A) * integral of chi |F a0| dV with chi = (1 - r^2/radius^2)^2 at the distance
/// r < radius from the axis at rest, A = pi radius^2 / 3 its integral over a cross-section, and a0
/// along the axis: a tension of `force` newtons, spread over the bundle. Parameter: force [N].
class ExtraMuscle final : public Potential {
 public:
  /// Throws InputError when the bundle from `from` to `to` meets no tissue.
  ExtraMuscle(const HexMesh& mesh, const Vec3& from, const Vec3& to, double radius, double force);

  std::string_view name() const override { return "extra_muscle"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  std::vector<FibreSample> samples_;
  std::array<ParameterInfo, 1> info_;
};

EffectKind extra_muscle_kind();

}  // namespace genio
