#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Targets of the model itself, from rest to the edge of what muscles can do: random vectors of 2
/// to 5 muscles, the strongest from next to nothing to its maximum.
Benchmark reach_bench();

}  // namespace genio::bench
