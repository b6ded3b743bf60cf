#pragma once
// Find what a model misses: localise, name, add, and show the gap shrink.

#include "discrepancy/contest/discover_options.hpp"
#include "discrepancy/contest/discovery.hpp"

namespace genio {

/// The verdict on effects that were added with these probabilities. `fit_tail`, `heldout_tail`: see
/// Discovery. Nothing is named while a gap beyond noise is left.
DiscoveryVerdict verdict_of(const std::vector<double>& confidence, double fit_tail,
                            double heldout_tail, const DiscoverOptions& options);

/// Runs the whole workflow. Throws InputError for observations that do not go with the model.
Discovery discover(const ModelDescription& description, const Observations& observations,
                   const DiscoverOptions& options = {});

}  // namespace genio
