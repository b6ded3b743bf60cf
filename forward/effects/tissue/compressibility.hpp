#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/effects/tissue/tissue_potential.hpp"

namespace genio {

/// Tissue that gives way to pressure more than the elasticity says: the bulk modulus becomes
/// 1 / (1/kappa + compliance). Parameter: compliance [1/Pa].
class Compressibility final : public TissuePotential {
 public:
  Compressibility(const HexMesh& mesh, double compliance);

  std::string_view name() const override { return "compressibility"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<ParameterName> borrows() const override { return {{"elasticity", "kappa"}}; }

 private:
  bool present(EffectParameters p) const override { return p[0] != 0; }
  BatchTissue tissue(size_t b, EffectParameters p) const override;
  BatchTissue tissue_derivative(size_t b, EffectParameters p, int k) const override;

  std::array<ParameterInfo, 1> info_;
};

EffectKind compressibility_kind();

}  // namespace genio
