#include "inverse/prior/base/read_normal.hpp"

namespace genio {
namespace {

// What anybody believes, in any unit: beyond, a double has no digits left for what is measured.
constexpr double smallest_sd = 1e-9, largest_sd = 1e12;

}  // namespace

double positive(const TomlReader& file, const toml::table& in, const char* key, double fallback) {
  const auto* node = in.get(key);
  if (!node) return fallback;
  const double v = file.number(*node, key);
  if (!(v > 0)) file.fail(*node, fmt::format("'{}' must be above 0", key));
  if (v < smallest_sd || v > largest_sd)
    file.fail(*node,
              fmt::format("'{}' must lie between {:g} and {:g}", key, smallest_sd, largest_sd));
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

Normal read_activation(const TomlReader& file, const toml::node& node, const std::string& name) {
  const Normal activation = read_normal(file, node, name);
  if (activation.mean < 0 || activation.mean > 1)
    file.fail(node, fmt::format("'{}': 'mean' must be an activation from 0 to 1", name));
  return activation;
}

}  // namespace genio
