#pragma once
// For sources only: what includes this links tomlplusplus.

#include "forward/base/toml_reader.hpp"
#include "inverse/prior/base/prior_rows.hpp"

namespace genio {

/// The number above 0, and of a size that somebody may mean, at a key, or `fallback` where the key
/// is not there. Throws InputError naming file, line and key.
double positive(const TomlReader& file, const toml::table& in, const char* key, double fallback);

/// A table of mean and sd, called `name` in errors. Throws InputError naming file, line and key.
Normal read_normal(const TomlReader& file, const toml::node& node, const std::string& name);

/// The same of an activation, whose mean lies from 0 to 1.
Normal read_activation(const TomlReader& file, const toml::node& node, const std::string& name);

}  // namespace genio
