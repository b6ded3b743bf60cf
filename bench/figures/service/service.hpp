#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Round trips over LCM on 127.0.0.1 beside the bare computation.
Benchmark service_bench();

}  // namespace genio::bench
