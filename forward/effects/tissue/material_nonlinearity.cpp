#include "forward/effects/tissue/material_nonlinearity.hpp"

#include "forward/effects/tissue/elasticity.hpp"

namespace genio {

MaterialNonlinearity::MaterialNonlinearity(const HexMesh& mesh, double a20, double a30,
                                           double own_a20)
    : TissuePotential(mesh),
      info_{{{.name = "a20", .unit = "Pa", .value = a20, .lower = -own_a20, .upper = 1e5},
             {.name = "a30", .unit = "Pa", .value = a30, .lower = -1e4, .upper = 1e5}}} {}

BatchTissue MaterialNonlinearity::tissue(size_t, EffectParameters p) const {
  return BatchTissue::uniform(0, p[0], p[1], 0);
}

BatchTissue MaterialNonlinearity::tissue_derivative(size_t, EffectParameters, int k) const {
  return BatchTissue::uniform(0, k == 0, k == 1, 0);
}

EffectKind material_nonlinearity_kind() {
  return {.name = "material_nonlinearity",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const double a20 = s.take("a20", 0), a30 = s.take("a30", 0);
            const auto& own = a.description.effects.at("elasticity");
            const auto own_a20 = own.find("a20");
            return {.potential = std::make_shared<MaterialNonlinearity>(
                        a.description.mesh, a20, a30,
                        own_a20 == own.end() ? TissueConstants{}.a20 : own_a20->second)};
          },
          .belief = {.parameters = {{.parameter = "a20", .typical = 2e3}}},
          .sample = {{"a20", 30}, {"a30", 50}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_number(
                    "material_nonlinearity",
                    {.key = "a20", .absent = 0, .unit = 1e3, .first = 3, .most = 90});
              }};
}

}  // namespace genio
