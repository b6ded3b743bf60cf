#pragma once
#include <string_view>

namespace genio {

/// True where a key of the TOML text has hundreds of parts, as in a.b.c: toml++ takes a call each
/// to throw them away, and a stack ends. It counts the levels of arrays and tables itself.
bool keys_too_deep(std::string_view toml);

}  // namespace genio
