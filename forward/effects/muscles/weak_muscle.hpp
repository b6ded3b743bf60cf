#pragma once
#include "forward/effects/kind.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// Muscles that deliver less than they are told: the share `loss` of a command does not arrive.
/// E = -sum_k loss_k T_k sum_s share_s L_s, with the commands T of the muscles.
/// Parameters: one a command ("GGP_L", ...), the share lost, 0 to 1.
class WeakMuscle final : public Potential {
 public:
  /// `loss`: a value for each muscle.
  WeakMuscle(std::vector<Muscle> muscles, const std::vector<double>& loss);

  std::string_view name() const override { return "weak_muscle"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<ParameterName> borrows() const override;
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  std::vector<Muscle> muscles_;
  std::vector<ParameterInfo> info_;
};

EffectKind weak_muscle_kind();

}  // namespace genio
