#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// Muscle force that falls off away from the fibre's best length.
///
/// A segment's tension is multiplied by 1 + strength (f - 1), f = exp(-((lambda -
/// optimum)/width)^2) with lambda = L / L_rest (the Gaussian of Thelen 2003, J. Biomech. Eng. 125,
/// eq. 4, whose gamma is width^2 = 0.45). Strength 0: force whatever the length, as the seed model
/// has it. Parameters: strength (0 to 1), width, optimum.
class ForceLength final : public Potential {
 public:
  ForceLength(std::vector<Muscle> muscles, double strength, double width, double optimum);

  std::string_view name() const override { return "force_length"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<ParameterName> borrows() const override;
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  std::vector<Muscle> muscles_;
  std::array<ParameterInfo, 3> info_;
};

EffectKind force_length_kind();

}  // namespace genio
