#pragma once
// The forward results of Gerard, Perrier & Payan, "3D biomechanical tongue modeling to study speech
// production", section 5.3, computed on any tongue.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "forward/model/model_file.hpp"

namespace genio {

/// The paper's five rows with the cadaver and the living constants, its forces read per side and in
/// all, contact off, with the palate, with the jaw (which carries the lower incisors) and with
/// both: what moved, beside what the paper prints; and how sharp the styloglossus' edges are.
/// Writes suite.json, suite.csv and pictures into `folder` unless that is empty. One line a row to
/// `progress`.
nlohmann::json seed_suite(const ModelDescription& tongue, const std::string& source,
                          const std::string& folder,
                          const std::function<void(const std::string&)>& progress);

}  // namespace genio
