#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The Grenoble tongue of --data under GGP and HG: without contact against an independent static
/// solution of the same problem, with contact beside the seed paper's printed figures.
Benchmark grenoble_bench();

}  // namespace genio::bench
