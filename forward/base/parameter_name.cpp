#include "forward/base/parameter_name.hpp"

#include "forward/base/types.hpp"

namespace genio {

std::optional<ParameterName> ParameterName::try_parse(const std::string& text) {
  const auto dot = text.find('.');
  if (dot == 0 || dot == std::string::npos || dot + 1 == text.size()) return {};
  return ParameterName{text.substr(0, dot), text.substr(dot + 1)};
}

ParameterName ParameterName::parse(const std::string& text) {
  if (auto name = try_parse(text)) return *std::move(name);
  throw InputError(text + ": expected EFFECT.PARAMETER, as in gravity.z");
}

}  // namespace genio
