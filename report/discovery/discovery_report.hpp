#pragma once
// What a discovery says, for programs.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "discrepancy/contest/discovery.hpp"

namespace genio {

/// One object with the keys of the interface and the whole ranking. `model`: where the patched
/// model was written; empty: none.
nlohmann::json to_json(const Discovery& discovery, const Observations& observations,
                       const std::string& model);

/// The same as text; `indent` -1: on one line.
std::string discovery_json(const Discovery& discovery, const Observations& observations,
                           const std::string& model, int indent = -1);

}  // namespace genio
