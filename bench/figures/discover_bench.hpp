#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The hidden-effect benchmark, or --sample random cases of it, in --threads processes. What is
/// done stands in OUT/results.jsonl and is not done again: an interrupted run goes on where it was.
/// --only-data makes the data sets and runs nothing. --only takes the cases whose names contain it;
/// where there is none, the run throws InputError.
Benchmark discover_bench();

}  // namespace genio::bench
