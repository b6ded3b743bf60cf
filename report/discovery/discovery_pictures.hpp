#pragma once
// A discovery as pictures.

#include <string>

#include "discrepancy/contest/discovery.hpp"

namespace genio {

/// Signed residual maps of the fitted conditions before and after, side by side, seen from the
/// left: an SVG. Red: the data lie outside the model; blue: inside; ringed: beyond noise.
std::string draw_maps(const Discovery& discovery, const Observations& observations);

/// Log odds of the candidates that were scored best, as bars: an SVG.
std::string draw_ranking(const Round& round, size_t most);

/// Midsagittal contours of all conditions, measured, before and after: an SVG.
std::string draw_contours(const Discovery& discovery, const Observations& observations);

}  // namespace genio
