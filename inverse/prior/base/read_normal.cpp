#include "inverse/prior/base/read_normal.hpp"

namespace genio {

double positive(const TomlReader& file, const toml::table& in, const char* key, double fallback) {
  const auto* node = in.get(key);
  if (!node) return fallback;
  const double v = file.number(*node, key);
  if (!(v > 0)) file.fail(*node, fmt::format("'{}' must be above 0", key));
  return v;
}

Normal read_normal(const TomlReader& file, const toml::node& node, const std::string& name) {
  if (!node.is_table()) file.fail(node, fmt::format("'{}' must be a table of mean and sd", name));
  const auto& table = *node.as_table();
  file.only(table, {"mean", "sd"});
  for (const char* key : {"mean", "sd"})
    if (!table.get(key)) file.fail(node, fmt::format("'{}': '{}' is missing", name, key));
  return {file.number(*table.get("mean"), "mean"), positive(file, table, "sd", 0)};
}

}  // namespace genio
