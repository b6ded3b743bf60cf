#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Static solves of the block in units of one factorisation, beside CalculiX where it is installed.
Benchmark forward_bench();

}  // namespace genio::bench
