#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/effects/tissue/tissue_potential.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// How the activations of muscles that share an element combine.
enum class Recruitment { sum, largest };

/// Active muscle is stiffer: an element's a10 and a20 grow by (factor - 1) times its activation,
/// the commands over their maxima, of the muscles that run through it: their sum up to 1, or the
/// largest (Buchaillard et al. 2009; Nazari et al. 2010: factor 10). Parameter: factor (absent 1).
class ActiveStiffening final : public TissuePotential {
 public:
  ActiveStiffening(const HexMesh& mesh, std::vector<Muscle> muscles, double factor,
                   Recruitment recruitment);

  std::string_view name() const override { return "active_stiffening"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  /// a10 and a20 of the elasticity, then the commands.
  std::vector<ParameterName> borrows() const override;

 private:
  bool present(EffectParameters p) const override { return p[0] != 1; }
  BatchTissue tissue(size_t b, EffectParameters p) const override;
  BatchTissue tissue_derivative(size_t b, EffectParameters p, int k) const override;
  double activation(int element, EffectParameters p) const;
  double activation_derivative(int element, EffectParameters p, int muscle) const;

  std::vector<Muscle> muscles_;
  std::vector<std::vector<int>> through_;  // muscles that run through each element
  Recruitment recruitment_;
  std::array<ParameterInfo, 1> info_;
};

EffectKind active_stiffening_kind();

}  // namespace genio
