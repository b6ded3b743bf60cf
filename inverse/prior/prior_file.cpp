#include "inverse/prior/prior_file.hpp"

#include <cmath>
#include <filesystem>

#include "forward/base/toml_reader.hpp"
#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

std::map<std::string, Normal> read_emg(const std::string& path) {
  TableLines lines(path);
  std::string line;
  if (!lines.next(line)) lines.fail("the file is empty; expected the header muscle,mean,sd");
  const auto header = split_fields(line, ',');
  if (header.size() != 3 || trimmed(header[0]) != "muscle" || trimmed(header[1]) != "mean" ||
      trimmed(header[2]) != "sd")
    lines.fail(fmt::format("header '{}'; expected muscle,mean,sd", trimmed(line)));
  std::map<std::string, Normal> result;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const auto fields = split_fields(line, ',');
    if (fields.size() != 3) lines.fail(fmt::format("{} fields; expected 3", fields.size()));
    Normal belief;
    if (!parse_number(fields[1], belief.mean) || belief.mean < 0 || belief.mean > 1)
      lines.fail(fmt::format("field mean: '{}'; expected an activation from 0 to 1", fields[1]));
    if (!parse_number(fields[2], belief.sd) || !(belief.sd > 0))
      lines.fail(fmt::format("field sd: '{}'; expected a number above 0", fields[2]));
    if (!result.emplace(trimmed(fields[0]), belief).second)
      lines.fail(fmt::format("muscle '{}' stands twice", trimmed(fields[0])));
  }
  if (result.empty()) lines.fail("the file has a header but no muscle");
  return result;
}

double positive(const TomlReader& file, const toml::table& in, const char* key, double fallback) {
  const auto* node = in.get(key);
  if (!node) return fallback;
  const double v = file.number(*node, key);
  if (!(v > 0)) file.fail(*node, fmt::format("'{}' must be above 0", key));
  return v;
}

Normal normal(const TomlReader& file, const toml::node& node, const std::string& name) {
  if (!node.is_table()) file.fail(node, fmt::format("'{}' must be a table of mean and sd", name));
  const auto& table = *node.as_table();
  file.only(table, {"mean", "sd"});
  for (const char* key : {"mean", "sd"})
    if (!table.get(key)) file.fail(node, fmt::format("'{}': '{}' is missing", name, key));
  return {file.number(*table.get("mean"), "mean"), positive(file, table, "sd", 0)};
}

}  // namespace

Prior read_prior(const std::string& path) {
  Prior prior;
  if (fs::path(path).extension() == ".csv") {
    prior.emg = read_emg(path);
    return prior;
  }
  const TomlReader file(path);
  const toml::table& root = file.root();
  file.only(root, {"effort_sd", "symmetry_sd", "smoothness_sd", "emg", "cocontraction", "fixed_N",
                   "parameter", "head_pose"});
  prior.effort_sd = positive(file, root, "effort_sd", prior.effort_sd);
  prior.smoothness_sd = positive(file, root, "smoothness_sd", prior.smoothness_sd);
  if (root.get("symmetry_sd")) prior.symmetry_sd = positive(file, root, "symmetry_sd", 0);
  if (root.get("emg"))
    prior.emg = read_emg((fs::path(path).parent_path() / file.text(root, "emg")).string());
  if (const auto* node = root.get("cocontraction"))
    prior.cocontraction = normal(file, *node, "cocontraction");
  if (root.get("fixed_N"))
    for (const auto& [name, force] : file.table(root, "fixed_N"))
      prior.fixed[std::string(name.str())] = file.number(force, std::string(name.str()));
  if (root.get("parameter"))
    for (const auto& [name, belief] : file.table(root, "parameter"))
      prior.parameters[std::string(name.str())] = {normal(file, belief, std::string(name.str()))};
  if (root.get("head_pose")) {
    const toml::table& pose = file.table(root, "head_pose");
    file.only(pose, {"shift_sd_mm", "turn_sd_deg"});
    prior.head_pose = {1e-3 * positive(file, pose, "shift_sd_mm", 1),
                       M_PI / 180 * positive(file, pose, "turn_sd_deg", 2)};
  }
  return prior;
}

}  // namespace genio
