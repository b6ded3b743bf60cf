#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The verification's tables: manufactured solution, Cook's membrane, sphere, order in time, and
/// CalculiX (where it is installed) on the block and, with --data, on the Grenoble tongue.
Benchmark verification_bench();

}  // namespace genio::bench
