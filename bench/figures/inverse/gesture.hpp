#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// A 200 ms gesture with two targets inverted with its inertia, over the time of its simulation.
Benchmark gesture_bench();

}  // namespace genio::bench
