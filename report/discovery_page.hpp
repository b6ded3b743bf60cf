#pragma once
// A discovery as pictures and as one page to read from top to bottom.

#include <string>

#include "discrepancy/discovery.hpp"

namespace genio {

/// Signed residual maps of the fitted conditions before and after, side by side, seen from the
/// left: an SVG. Red: the data lie outside the model; blue: inside; ringed: beyond noise.
std::string draw_maps(const Discovery& discovery, const Observations& observations);

/// Log odds of the candidates that were scored best, as bars: an SVG.
std::string draw_ranking(const Round& round, size_t most);

/// One self-contained HTML page: where, what, how sure, what changed.
std::string discovery_page(const Discovery& discovery, const Observations& observations,
                           const std::string& title);

}  // namespace genio
