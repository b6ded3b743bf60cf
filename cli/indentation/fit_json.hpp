#pragma once
#include <string>

#include "speaker/indentation/tissue_fit.hpp"

namespace genio::cli {

/// What `genio indent` says of a fit: one JSON object. `indent` -1: on one line.
std::string fit_json(const IndentationExperiment& experiment, const ForceData& data,
                     const TissueFit& fit, int indent = -1);

}  // namespace genio::cli
