#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The Grenoble tongue of --data in postures that CalculiX makes with gravity, seen with noise;
/// what the discovery says of a model without gravity.
Benchmark grenoble_gravity_bench();

}  // namespace genio::bench
