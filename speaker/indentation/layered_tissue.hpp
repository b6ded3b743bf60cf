#pragma once
#include <array>
#include <vector>

#include "forward/effects/tissue/tissue_potential.hpp"
#include "speaker/indentation/block.hpp"

namespace genio {

/// Muscle with a mucosa on it, both of Yeoh's law with the same bulk modulus over a10. Parameters:
/// a10, a20 of the muscle, mucosa_a10, mucosa_a20 [Pa]. Force is linear in them.
class LayeredTissue final : public TissuePotential {
 public:
  LayeredTissue(const IndentedBlock& block, const YeohConstants& muscle,
                const YeohConstants& mucosa, double bulk_over_a10);

  std::string_view name() const override { return "tissue"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double step_limit(const Positions& x, const Positions& along, EffectParameters) const override {
    return volume_step_limit(x, along);
  }

 private:
  BatchTissue tissue(size_t b, EffectParameters p) const override;
  BatchTissue tissue_derivative(size_t b, EffectParameters, int k) const override;

  std::vector<lanes::Lane> mucosa_;  // 1 where an element of the batch is mucosa
  double bulk_over_a10_;
  std::array<ParameterInfo, 4> info_;
};

}  // namespace genio
