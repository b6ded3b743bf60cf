#pragma once
#include <vector>

#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The figures and the confusion matrix of results of run_discover_case().
Json discover_figures(const std::vector<Json>& results);

}  // namespace genio::bench
