#include "forward/base/toml_depth.hpp"

namespace genio {

bool keys_too_deep(std::string_view toml) {
  constexpr int deepest = 200;
  int dots = 0;  // since what ends a key
  char before = '\n';
  for (const char c : toml) {
    if (c == '.' && before != '.' && ++dots > deepest) return true;  // no part is empty
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots = 0;
    if (c != ' ' && c != '\t') before = c;
  }
  return false;
}

}  // namespace genio
