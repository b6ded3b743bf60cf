#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// One frame from the middle of each label (word) of a recording, each cold, or with --all all
/// frames, each from where the one before ended; registered by its palate trace.
Benchmark ultrasound_bench();

}  // namespace genio::bench
