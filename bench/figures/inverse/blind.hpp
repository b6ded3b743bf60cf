#pragma once
#include "bench/problems/benchmark.hpp"
#include "forward/model/model_file.hpp"

namespace genio::bench {

/// Inversion without inverse crime: targets from the model refined by eight with fibres turned by 5
/// degrees, 0.5 mm noise, `count` random force vectors of 2 to 5 muscles up to 30 % of maximum.
/// RMS from the clean shape, coverage of the 90 % intervals, error of identified forces.
Json blind(const ModelDescription& description, int count, const Progress& progress);

}  // namespace genio::bench
