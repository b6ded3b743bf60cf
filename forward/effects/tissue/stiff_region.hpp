#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/effects/tissue/tissue_potential.hpp"

namespace genio {

/// A ball of stiffer (or softer) tissue, a scar or a tumour: a10 and a20 grow by (factor - 1) chi,
/// chi = (1 - r^2/radius^2)^3 at the distance r < radius from the centre at rest, so that place and
/// size have derivatives too; a material_nonlinearity's a20 and a30 with them. Parameters: factor
/// (absent 1), x, y, z, radius [m].
class StiffRegion final : public TissuePotential {
 public:
  /// `nonlinear`: the tongue has a material_nonlinearity, too.
  StiffRegion(const HexMesh& mesh, double factor, const Vec3& centre, double radius,
              bool nonlinear);

  std::string_view name() const override { return "stiff_region"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<ParameterName> borrows() const override { return borrows_; }

 private:
  bool present(EffectParameters p) const override { return p[0] != 1; }
  BatchTissue tissue(size_t b, EffectParameters p) const override;
  BatchTissue tissue_derivative(size_t b, EffectParameters p, int k) const override;

  std::vector<std::array<std::array<Vec3, lanes::width>, 8>> points_;  // Gauss points of each batch
  std::array<ParameterInfo, 5> info_;
  std::vector<ParameterName> borrows_{{"elasticity", "a10"}, {"elasticity", "a20"}};
};

EffectKind stiff_region_kind();

}  // namespace genio
