#pragma once
// Members of a JSON object, which may lack them. Not for other rooms.

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace genio {

/// NaN where there is no such number: JSON has none for what is not finite.
inline double number(const nlohmann::json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number() ? it->get<double>() : std::nan("");
}

inline std::string word(const nlohmann::json& object, const char* key, const char* otherwise = "") {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : otherwise;
}

inline bool flag(const nlohmann::json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && *it == true;
}

}  // namespace genio
