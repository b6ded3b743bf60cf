#pragma once
#include "speaker/indentation/force_data.hpp"

namespace genio {

/// A measurement of known tissue: `rows` depths, evenly from depth/rows to `depth` [m], with forces
/// that scatter by `scatter` of each (normal). `sd` is that part of the force without scatter.
/// Throws std::runtime_error where there is no such curve.
ForceData simulated_data(const Experiment& experiment, const BlockTissue& tissue, double depth,
                         int rows, double scatter, unsigned seed, const BlockGrid& grid = {});

}  // namespace genio
