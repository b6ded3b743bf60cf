#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/effects/tissue/tissue_potential.hpp"

namespace genio {

/// Strain stiffening beyond the elasticity's own: W = a20 (I - 3)^2 + a30 (I - 3)^3 on top of it.
/// Parameters: a20, a30 [Pa]; a20 takes away at most the elasticity's own, as tissue that softens
/// has no stable shape.
class MaterialNonlinearity final : public TissuePotential {
 public:
  /// `own_a20`: the elasticity's.
  MaterialNonlinearity(const HexMesh& mesh, double a20, double a30, double own_a20);

  std::string_view name() const override { return "material_nonlinearity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }

 private:
  bool present(EffectParameters p) const override { return p[0] != 0 || p[1] != 0; }
  BatchTissue tissue(size_t b, EffectParameters p) const override;
  BatchTissue tissue_derivative(size_t b, EffectParameters p, int k) const override;

  std::array<ParameterInfo, 2> info_;
};

EffectKind material_nonlinearity_kind();

}  // namespace genio
