#include "speaker/indentation/layered_tissue.hpp"

namespace genio {

LayeredTissue::LayeredTissue(const IndentedBlock& block, const YeohConstants& muscle,
                             const YeohConstants& mucosa, double bulk)
    : TissuePotential(block.mesh),
      bulk_over_a10_(bulk),
      info_{{{.name = "a10", .unit = "Pa", .value = muscle.a10, .lower = 1, .upper = 1e7},
             {.name = "a20", .unit = "Pa", .value = muscle.a20, .lower = 0, .upper = 1e7},
             {.name = "mucosa_a10", .unit = "Pa", .value = mucosa.a10, .lower = 1, .upper = 1e7},
             {.name = "mucosa_a20", .unit = "Pa", .value = mucosa.a20, .lower = 0, .upper = 1e7}}} {
  for (const ElementBatch& batch : batches_) {
    lanes::Lane in{};
    for (int l = 0; l < lanes::width; ++l) in[l] = block.mucosa[size_t(batch.element[size_t(l)])];
    mucosa_.push_back(in);
  }
}

BatchTissue LayeredTissue::tissue(size_t b, EffectParameters p) const {
  const lanes::Lane in = mucosa_[b], out = 1.0 - in;
  const lanes::Lane a10 = p[0] * out + p[2] * in, a20 = p[1] * out + p[3] * in;
  BatchTissue t;
  t.law.fill({a10, a20, lanes::splat(0)});
  t.kappa = bulk_over_a10_ * a10;
  return t;
}

BatchTissue LayeredTissue::tissue_derivative(size_t b, EffectParameters, int k) const {
  const double unit[4] = {double(k == 0), double(k == 1), double(k == 2), double(k == 3)};
  return tissue(b, unit);
}

}  // namespace genio
