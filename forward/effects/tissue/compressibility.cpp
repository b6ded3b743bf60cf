#include "forward/effects/tissue/compressibility.hpp"

namespace genio {

Compressibility::Compressibility(const HexMesh& mesh, double compliance)
    : TissuePotential(mesh),
      info_{{{.name = "compliance",
              .unit = "1/Pa",
              .value = compliance,
              .lower = 0,
              .upper = 1e-2}}} {}

BatchTissue Compressibility::tissue(size_t, EffectParameters p) const {
  return BatchTissue::uniform(0, 0, 0, p[1] / (1 + p[0] * p[1]) - p[1]);
}

BatchTissue Compressibility::tissue_derivative(size_t, EffectParameters p, int k) const {
  const double share = 1 / (1 + p[0] * p[1]);  // of kappa that is left
  const double slope = k == 0 ? -p[1] * p[1] * share * share : share * share - 1;
  return BatchTissue::uniform(0, 0, 0, slope);
}

EffectKind compressibility_kind() {
  return {.name = "compressibility",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            return {.potential = std::make_shared<Compressibility>(a.description.mesh,
                                                                   s.take("compliance", 0))};
          },
          .belief = {.parameters = {{.parameter = "compliance", .typical = 5e-5}}},
          .sample = {{"compliance", 2e-5}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_number(
                    "compressibility",
                    {.key = "compliance", .absent = 0, .unit = 1e-5, .first = 3, .most = 100});
              }};
}

}  // namespace genio
