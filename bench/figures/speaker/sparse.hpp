#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Every speaker left out in turn: from his palate and rest contour, by the modes of the others,
/// his hidden outline (floor, root, hyoid), against that of the scaled model.
Json sparse_figures(const BenchOptions& o, const Progress& progress);

}  // namespace genio::bench
