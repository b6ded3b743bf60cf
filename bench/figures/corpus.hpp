#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// 60 recordings of three speakers, answered on this machine and, where there is a Slurm, as a job
/// array: whether the results are the same, and what the array costs beside the computing.
Benchmark corpus_bench();

}  // namespace genio::bench
