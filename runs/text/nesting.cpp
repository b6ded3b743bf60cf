#include "runs/text/nesting.hpp"

namespace genio {

bool nested_too_deep(std::string_view json) {
  constexpr int deepest = 50;
  int depth = 0;
  bool quoted = false;
  for (size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (quoted && c == '\\') ++k;
    else if (c == '"') quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{') && ++depth > deepest) return true;
    else if (!quoted && (c == ']' || c == '}')) --depth;
  }
  return false;
}

}  // namespace genio
