#pragma once
// A discovery as one page to read from top to bottom.

#include <string>

#include "discrepancy/contest/discovery.hpp"

namespace genio {

/// One self-contained HTML page: where, what, how sure, what changed.
std::string discovery_page(const Discovery& discovery, const Observations& observations,
                           const std::string& title);

}  // namespace genio
