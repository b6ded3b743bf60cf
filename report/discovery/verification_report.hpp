#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace genio {

/// Writes the verification's tables (verification.json) and their plots as SVG into `folder`.
void write_verification(const nlohmann::json& tables, const std::string& folder);

}  // namespace genio
