#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The Grenoble tongue of --data asked to move 22 nodes 10 mm forward, where a stored run of the
/// peer's inverse controller misses by 2.07 mm RMS.
Benchmark peer_bench();

}  // namespace genio::bench
