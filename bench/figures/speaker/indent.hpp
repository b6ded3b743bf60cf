#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Indentation: forces against the formulas of the linear theory, and the constants of the seed's
/// four conditions from curves with 5 % scatter, made on a finer mesh than they are fitted on.
Benchmark indent_bench();

}  // namespace genio::bench
