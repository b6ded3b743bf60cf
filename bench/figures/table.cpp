#include "bench/figures/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/experiments/grenoble_gravity.hpp"
#include "bench/experiments/recordings/recordings.hpp"
#include "bench/experiments/seed_suite.hpp"
#include "bench/experiments/ultrasound.hpp"
#include "bench/figures/corpus.hpp"
#include "bench/figures/discover_bench.hpp"
#include "bench/figures/forward/deformation.hpp"
#include "bench/figures/forward/dynamic.hpp"
#include "bench/figures/forward/forward.hpp"
#include "bench/figures/forward/grenoble.hpp"
#include "bench/figures/forward/robustness.hpp"
#include "bench/figures/forward/verification.hpp"
#include "bench/figures/inverse/calibration.hpp"
#include "bench/figures/inverse/gesture.hpp"
#include "bench/figures/inverse/inverse.hpp"
#include "bench/figures/inverse/peer.hpp"
#include "bench/figures/inverse/reach.hpp"
#include "bench/figures/service/service.hpp"
#include "bench/figures/speaker/indent.hpp"
#include "bench/figures/speaker/speaker.hpp"
#include "forward/base/types.hpp"

namespace genio::bench {
namespace {

/// Whether the option is given, of those that a benchmark can need.
bool given(const BenchOptions& o, const std::string& name) {
  if (name == "--data") return !o.data.empty();
  if (name == "--target") return !o.target.empty();
  if (name == "--palate") return !o.palate.empty();
  throw std::logic_error(name + ": is no option that a benchmark can need");
}

}  // namespace

const std::vector<Benchmark>& benchmarks() {
  static const std::vector<Benchmark> all = {
      forward_bench(),    dynamic_bench(),     robustness_bench(), verification_bench(),
      inverse_bench(),    calibration_bench(), reach_bench(),      peer_bench(),
      gesture_bench(),    discover_bench(),    service_bench(),    recordings_bench(),
      corpus_bench(),     ultrasound_bench(),  grenoble_bench(),   grenoble_gravity_bench(),
      seed_suite_bench(), deformation_bench(), indent_bench(),     speaker_bench()};
  return all;
}

const Benchmark& benchmark(const std::string& name) {
  std::vector<std::string> names;
  for (const Benchmark& b : benchmarks()) {
    if (b.name == name) return b;
    names.push_back(b.name);
  }
  throw InputError(
      fmt::format("bench {}: no such benchmark; expected {}", name, fmt::join(names, ", ")));
}

Json run_benchmark(const Benchmark& b, const BenchOptions& options, const Progress& progress) {
  for (const BenchOption& option : b.options)
    if (option.needed && !given(options, option.name))
      throw InputError(fmt::format("bench {}: needs {}", b.name, option.name));
  return b.run(options, progress);
}

}  // namespace genio::bench
