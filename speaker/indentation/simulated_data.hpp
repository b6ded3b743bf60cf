#pragma once
#include "speaker/indentation/force_data.hpp"

namespace genio {

/// A measurement of known tissue: `rows` depths, evenly from depth/rows to `depth` [m], with forces
/// as scattered() makes them, or exact ones without `sd` where `scatter` is 0. Throws
/// std::runtime_error where there is no such curve.
ForceData simulated_data(const IndentationExperiment& experiment, const BlockTissue& tissue,
                         double depth, int rows, double scatter, unsigned seed,
                         const BlockGrid& grid = {});

/// The same depths with forces that scatter by a part of each (normal), and that part as `sd`.
ForceData scattered(const ForceData& exact, double scatter, unsigned seed);

}  // namespace genio
