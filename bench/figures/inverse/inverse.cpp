#include "bench/figures/inverse/inverse.hpp"

#include <nlohmann/json.hpp>

#include "bench/figures/inverse/blind.hpp"
#include "bench/figures/inverse/inversion_cost.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"

namespace genio::bench {
namespace {

Json run_inverse(const BenchOptions& o, const Progress& progress) {
  Json j = inversion_cost(read_model(o.model), progress);
  j.update(blind(read_description(o.model), o.sample > 0 ? o.sample : 20, progress));
  return j;
}

}  // namespace

Benchmark inverse_bench() {
  return {
      .name = "inverse",
      .about = "Cost of an inversion beside the forward solve; calibration without inverse crime",
      .options = {{"--sample", "random targets (20)"}},
      .run = run_inverse};
}

}  // namespace genio::bench
