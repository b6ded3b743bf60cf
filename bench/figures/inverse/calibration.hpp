#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Whether what answers say is true: how often 90 % intervals hold the force of muscles that act
/// and of muscles that rest, by what was measured, how strongly muscles act and in what the truth
/// differs from the model. No truth is solved on the model's own mesh.
Benchmark calibration_bench();

}  // namespace genio::bench
