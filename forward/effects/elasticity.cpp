#include "forward/effects/elasticity.hpp"

namespace genio {

Elasticity::Elasticity(const HexMesh& mesh, const TissueConstants& c)
    : TissueEffect(mesh),
      info_{{{"a10", "Pa", c.a10, 1, 1e6, 0},
             {"a20", "Pa", c.a20, 0, 1e6, 0},
             {"kappa", "Pa", c.kappa, 1e3, 1e10, 0}}} {}

double Elasticity::step_limit(const Positions& x, const Positions& along, EffectParameters) const {
  double t = 1.0;
  Positions reached = x + along;
  BatchShape before, after;
  for (size_t b = 0; b < batches_.size(); ++b) {
    const ElementBatch& batch = batches_[b];
    if (!deform(batch, x, before)) continue;
    const auto keeps_volume = [&] {
      if (!deform(batch, reached, after)) return false;
      for (int q = 0; q < 8; ++q)
        if (lanes::any_not_positive(after.j[q] - 0.25 * before.j[q], batch.count)) return false;
      return true;
    };
    while (t > 1e-3 && !keeps_volume()) t *= 0.7, reached = x + t * along;
  }
  return t;
}

}  // namespace genio
