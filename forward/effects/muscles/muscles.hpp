#pragma once
#include "forward/effects/kind.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// Muscle tension along fibres that follow the deformation.
///
/// E = sum over commands T_k of T_k * sum over its segments s of share_s * L_s: a segment pulls its
/// two ends together with the force T_k share_s along its present direction (the distributed forces
/// of Payan & Perrier 1997, in large deformation); very short segments let go (unit_tension).
/// Parameters: one a command ("GGP_L", ...), its whole force [N], from 0 to the muscle's maximum.
class Muscles final : public Potential {
 public:
  explicit Muscles(std::vector<Muscle> muscles);

  std::string_view name() const override { return "muscles"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;
  std::vector<std::pair<int, int>> couplings() const override;

 private:
  std::vector<Muscle> muscles_;
  std::vector<ParameterInfo> info_;
};

/// The effect "muscles", whose parameters are the commands.
Effect muscle_commands(std::vector<Muscle> muscles);

EffectKind muscles_kind();

}  // namespace genio
