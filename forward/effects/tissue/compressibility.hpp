#pragma once
#include <array>

#include "forward/effects/tissue/tissue_effect.hpp"

namespace genio {

/// Tissue that gives way to pressure more than the elasticity says: the bulk modulus becomes
/// 1 / (1/kappa + compliance). Parameter: compliance [1/Pa].
class Compressibility final : public TissueEffect {
 public:
  Compressibility(const HexMesh& mesh, double compliance)
      : TissueEffect(mesh),
        info_{{{"compliance", "1/Pa", compliance, 0, 1e-2, 0, false, false, 5e-5}}} {}

  std::string_view name() const override { return "compressibility"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<std::string> borrows() const override { return {"elasticity.kappa"}; }

 private:
  bool present(EffectParameters p) const override { return p[0] != 0; }
  BatchTissue tissue(size_t, EffectParameters p) const override {
    return BatchTissue::uniform(0, 0, 0, p[1] / (1 + p[0] * p[1]) - p[1]);
  }
  BatchTissue tissue_derivative(size_t, EffectParameters p, int k) const override {
    const double share = 1 / (1 + p[0] * p[1]);  // of kappa that is left
    const double slope = k == 0 ? -p[1] * p[1] * share * share : share * share - 1;
    return BatchTissue::uniform(0, 0, 0, slope);
  }

  std::array<ParameterInfo, 1> info_;
};

}  // namespace genio
