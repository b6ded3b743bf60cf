#pragma once
// For sources only: what includes this links tomlplusplus.

#include "forward/base/toml_reader.hpp"
#include "inverse/prior/base/prior_rows.hpp"

namespace genio {

/// The number above 0 at a key, or `fallback` where the key is not there. Throws InputError naming
/// file, line and key.
double positive(const TomlReader& file, const toml::table& in, const char* key, double fallback);

/// A table of mean and sd, called `name` in errors. Throws InputError naming file, line and key.
Normal read_normal(const TomlReader& file, const toml::node& node, const std::string& name);

}  // namespace genio
