#include "forward/effects/tissue/elasticity.hpp"

#include "forward/effects/tissue/tissue_viscosity.hpp"

namespace genio {

Elasticity::Elasticity(const HexMesh& mesh, const TissueConstants& c)
    : TissuePotential(mesh),
      info_{{{.name = "a10", .unit = "Pa", .value = c.a10, .lower = 1, .upper = 1e6},
             {.name = "a20", .unit = "Pa", .value = c.a20, .lower = 0, .upper = 1e6},
             {.name = "kappa", .unit = "Pa", .value = c.kappa, .lower = 1e3, .upper = 1e10}}} {}

Effect elastic_tissue(const HexMesh& mesh, const TissueConstants& constants, bool viscous) {
  const auto elasticity = std::make_shared<Elasticity>(mesh, constants);
  if (!viscous) return {.potential = elasticity};
  const auto viscosity = std::make_shared<TissueViscosity>(elasticity);
  return {.potential = elasticity, .dissipation = viscosity, .joint = viscosity};
}

EffectKind elasticity_kind() {
  return {.name = "elasticity",
          .make =
              [](Settings& s, const Anatomy& a) {
                TissueConstants c;
                c.a10 = s.take("a10", c.a10);
                c.a20 = s.take("a20", c.a20);
                c.kappa = s.take("kappa", 1000 * c.a10);
                return elastic_tissue(a.description.mesh, c,
                                      a.description.effects.contains("viscosity"));
              },
          .sample = {{"a10", 192}, {"a20", 90}, {"kappa", 19200}}};
}

}  // namespace genio
