#pragma once
// For sources only: what includes this links tomlplusplus.

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "forward/base/input_file.hpp"
#include "forward/base/nearest_name.hpp"
#include "forward/base/toml_depth.hpp"
#include "forward/base/types.hpp"

namespace genio {

/// A TOML file with errors that name file, line and key.
class TomlReader {
 public:
  explicit TomlReader(const std::string& path)
      : TomlReader(path, true, read_file(path, largest_settings)) {}
  /// Text that came without a file; errors call it `name`.
  static TomlReader of_text(const std::string& name, const std::string& text) {
    return TomlReader(name, false, text);
  }
  const toml::table& root() const { return root_; }
  const std::string& path() const { return path_; }
  bool is_file() const { return is_file_; }

  [[noreturn]] void fail(const toml::node& at, const std::string& what) const {
    throw InputError(fmt::format("{}: {}", place(at.source()), what));
  }
  const toml::table& table(const toml::table& in, const std::string& key) const {
    const auto* node = in.get(key);
    if (!node) throw InputError(fmt::format("{}: [{}] is missing", path_, key));
    if (!node->is_table()) fail(*node, fmt::format("'{}' must be a table", key));
    return *node->as_table();
  }
  void only(const toml::table& in, const std::vector<std::string>& known) const {
    for (const auto& [key, node] : in)
      if (std::find(known.begin(), known.end(), key.str()) == known.end())
        fail(node, fmt::format("unknown key '{}'; did you mean {}?", key.str(),
                               nearest_name(std::string(key.str()), known)));
  }
  double number(const toml::node& node, const std::string& key) const {
    const auto v = node.value<double>();
    if (!v || node.is_boolean() || !std::isfinite(*v))
      fail(node, fmt::format("'{}' must be a finite number", key));
    return *v;
  }
  bool truth(const toml::node& node, const std::string& key) const {
    if (!node.is_boolean()) fail(node, fmt::format("'{}' must be true or false", key));
    return **node.as_boolean();
  }
  std::string text(const toml::table& in, const std::string& key) const {
    const auto* node = in.get(key);
    if (!node) fail(in, fmt::format("'{}' is missing", key));
    if (!node->is_string()) fail(*node, fmt::format("'{}' must be a string", key));
    return **node->as_string();
  }
  int node_number(const toml::node& node, const std::string& key, size_t count) const {
    const auto v = node.value_exact<int64_t>();
    if (!v || *v < 0 || *v >= int64_t(count))
      fail(node, fmt::format("'{}' must be a node number from 0 to {}", key, count - 1));
    return int(*v);
  }

 private:
  TomlReader(const std::string& path, bool is_file, const std::string& text)
      : path_(path), is_file_(is_file) {
    if (keys_too_deep(text)) throw InputError(path_ + ": a key of hundreds of parts is no key");
    try {
      root_ = toml::parse(text, path_);
    } catch (const toml::parse_error& e) {
      throw InputError(fmt::format("{}: {}", place(e.source()), e.description()));
    }
  }
  /// "FILE:7", and of a text "NAME, line 7".
  std::string place(const toml::source_region& at) const {
    return fmt::format("{}{}{}", path_, is_file_ ? ":" : ", line ", at.begin.line);
  }

  std::string path_;
  bool is_file_;
  toml::table root_;
};

}  // namespace genio
