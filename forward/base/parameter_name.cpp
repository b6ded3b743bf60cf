#include "forward/base/parameter_name.hpp"

#include "forward/base/types.hpp"

namespace genio {

ParameterName ParameterName::parse(const std::string& text) {
  const auto dot = text.find('.');
  if (dot == 0 || dot == std::string::npos || dot + 1 == text.size())
    throw InputError(text + ": expected EFFECT.PARAMETER, as in gravity.z");
  return {text.substr(0, dot), text.substr(dot + 1)};
}

}  // namespace genio
