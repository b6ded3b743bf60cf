#pragma once
#include <vector>

#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Every benchmark: a new one is its own two files and a line here.
const std::vector<Benchmark>& benchmarks();

/// The one of that name. Throws InputError that lists the names where there is none.
const Benchmark& benchmark(const std::string& name);

/// Runs it. Throws InputError where an option that it needs is missing.
Json run_benchmark(const Benchmark& benchmark, const BenchOptions& options,
                   const Progress& progress);

}  // namespace genio::bench
