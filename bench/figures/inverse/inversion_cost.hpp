#pragma once
#include "bench/problems/benchmark.hpp"
#include "forward/model/model.hpp"

namespace genio::bench {

/// Known forces of three muscles found again from their noiseless contour: time of a cold and of a
/// warm inversion over that of the forward solve, and of the same optimiser with a
/// finite-difference gradient over that with the exact one.
Json inversion_cost(const Model& model, const Progress& progress);

}  // namespace genio::bench
