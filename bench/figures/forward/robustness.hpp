#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Equilibria under random force vectors up to half of every maximum, from rest, and once more from
/// a neighbour. Pairs of different equilibria for the same forces are listed.
Benchmark robustness_bench();

}  // namespace genio::bench
