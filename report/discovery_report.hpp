#pragma once
// What a discovery says, for programs.

#include <nlohmann/json.hpp>

#include "discrepancy/contest/discovery.hpp"

namespace genio {

/// One object with the keys of the interface and the whole ranking. `model`: where the patched
/// model was written; empty: none.
nlohmann::json to_json(const Discovery& discovery, const Observations& observations,
                       const std::string& model);

}  // namespace genio
