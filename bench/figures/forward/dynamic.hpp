#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// 120 ms of motion in 2 ms steps: the block, and GGP 2 N on the model of the options and on the
/// Grenoble tongue of --data (may be left out), whole and half.
Benchmark dynamic_bench();

}  // namespace genio::bench
