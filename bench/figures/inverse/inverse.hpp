#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// What inversion_cost() and blind() say of the model.
Benchmark inverse_bench();

}  // namespace genio::bench
