#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Speakers who differ from the model along one mode of anatomy by one or two standard deviations,
/// on tongues that err otherwise too; eight postures each, forces unknown. How often the intervals
/// of modes and forces hold the truth where both are estimated together.
Json hidden_anatomy_figures(const BenchOptions& o, const Progress& progress);

}  // namespace genio::bench
