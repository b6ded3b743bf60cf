#pragma once
#include <optional>
#include <string>

namespace genio {

/// A parameter of an effect: "gravity.z" is key "z" of effect "gravity".
struct ParameterName {
  std::string effect, key;

  std::string text() const { return effect + "." + key; }
  auto operator<=>(const ParameterName&) const = default;

  /// From "effect.key". Throws InputError when either part is missing.
  static ParameterName parse(const std::string& text);
  /// The same; nothing where either part is missing.
  static std::optional<ParameterName> try_parse(const std::string& text);
};

}  // namespace genio
