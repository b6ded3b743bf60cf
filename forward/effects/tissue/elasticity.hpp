#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/effects/tissue/tissue_potential.hpp"

namespace genio {

struct TissueConstants {
  double a10 = 1037;       ///< [Pa] living tongue (Buchaillard et al. 2009)
  double a20 = 486;        ///< [Pa]
  double kappa = 1037000;  ///< bulk modulus [Pa]; at least 1000 a10 keeps the volume to 0.1 %
};

/// Passive tissue: the same Yeoh law everywhere (batch_energy). Parameters: a10, a20, kappa [Pa].
class Elasticity final : public TissuePotential {
 public:
  Elasticity(const HexMesh& mesh, const TissueConstants& constants);

  std::string_view name() const override { return "elasticity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double step_limit(const Positions& x, const Positions& along, EffectParameters) const override {
    return volume_step_limit(x, along);
  }

  const std::vector<ElementBatch>& batches() const { return batches_; }
  /// What every element is made of.
  static BatchTissue uniform(EffectParameters p) {
    return BatchTissue::uniform(p[0], p[1], 0, p[2]);
  }

 private:
  BatchTissue tissue(size_t, EffectParameters p) const override { return uniform(p); }
  BatchTissue tissue_derivative(size_t, EffectParameters, int k) const override {
    return BatchTissue::uniform(k == 0, k == 1, 0, k == 2);
  }

  std::array<ParameterInfo, 3> info_;
};

/// The effect "elasticity". `viscous`: the model has a viscosity, whose part that goes with the
/// tissue's stiffness is carried here, next to the kernels (TissueViscosity).
Effect elastic_tissue(const HexMesh& mesh, const TissueConstants& constants, bool viscous = false);

EffectKind elasticity_kind();

}  // namespace genio
