#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

Benchmark recordings_bench();

}  // namespace genio::bench
