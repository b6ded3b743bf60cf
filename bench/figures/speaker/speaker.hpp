#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Models adapted to speakers' outlines: how closely, with how good elements, and whether an
/// equilibrium is found on each.
Benchmark speaker_bench();

}  // namespace genio::bench
