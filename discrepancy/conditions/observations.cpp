#include "discrepancy/conditions/observations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "forward/base/toml_reader.hpp"
#include "forward/model/build_effects.hpp"
#include "forward/model/effect_kinds.hpp"
#include "forward/model/hypothesis.hpp"
#include "inverse/recording/contour_file.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/session/session.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> condition_keys = {
    "name", "target", "frame", "forces_N", "force_sd_percent", "effects", "heldout"};
const std::vector<std::string> file_keys = {"noise_mm",         "noise_correlation_mm",
                                            "force_sd_percent", "bilateral",
                                            "effort_sd",        "head_pose",
                                            "palate",           "condition"};

double number_or(const TomlReader& file, const toml::table& in, const char* key, double fallback,
                 double least) {
  const auto* node = in.get(key);
  if (!node) return fallback;
  const double v = file.number(*node, key);
  if (!(v >= least)) file.fail(*node, fmt::format("'{}' = {}; expected {} or more", key, v, least));
  return v;
}

bool flag_or(const TomlReader& file, const toml::table& in, const char* key, bool fallback) {
  const auto* node = in.get(key);
  if (!node) return fallback;
  return file.truth(*node, key);
}

/// The known commands by their maxima; "GGP" speaks of both sides.
std::map<std::string, Normal> known_forces(const TomlReader& file, const toml::table& table,
                                           double sd_percent, const Model& model) {
  std::map<std::string, Normal> forces;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const double f = file.number(node, name);
    Parameters p = default_parameters(model);
    try {
      set_command(model, name, f, p);
    } catch (const InputError& e) {
      file.fail(node, e.what());
    }
    const auto which = command_parameters(model, name);
    for (int k : which) {
      const auto& slot = model.parameters[size_t(k)].info;
      forces[slot.name] = {p[k], 0.01 * sd_percent * p[k]};
    }
  }
  return forces;
}

/// Contour files of the conditions, each read and registered once.
class ContourFiles {
 public:
  /// `palate`: trace of the same session, beside the observations; empty: none.
  ContourFiles(const Model& model, std::string palate)
      : model_(model), palate_(std::move(palate)) {}

  struct Read {
    ContourFile file;
    Similarity to_model;  // of a file in axes of its own
  };
  const Read& operator()(const std::string& path) {
    if (const auto known = read_.find(path); known != read_.end()) return known->second;
    Read r{};
    SessionFile file = read_session_file(path, {});
    if (file.file.model_frame) {
      r.file = std::move(file.file);
    } else {
      if (palate_.empty())
        throw InputError(path +
                         ": these contours are not in the model's frame; name the palate trace of "
                         "the same session by 'palate' in the observations file");
      const SessionFile palate = read_palate(palate_, {}, file);
      AlignedRecording aligned = align(model_, std::move(file), palate, {});
      if (!aligned.judgement.faults.empty())
        throw InputError(fmt::format("{}: cannot be laid beside the model: {}", path,
                                     fmt::join(aligned.judgement.faults, "; ")));
      r = {std::move(aligned.file), aligned.registration.transform};
    }
    return read_.emplace(path, std::move(r)).first->second;
  }

 private:
  const Model& model_;
  std::string palate_;
  std::map<std::string, Read> read_;
};

std::string beside(const TomlReader& file, const std::string& name) {
  return (fs::path(file.path()).parent_path() / name).string();
}

Target read_target(const TomlReader& file, const toml::table& table, const Model& model,
                   double noise, ContourFiles& files) {
  const std::string path = beside(file, file.text(table, "target"));
  const auto& [contours, to_model] = files(path);
  const auto* node = table.get("frame");
  size_t index = 0;
  if (node) {
    const auto number = node->value_exact<int64_t>();
    while (index < contours.frames.size() && (!number || contours.frames[index].number != *number))
      ++index;
    if (index == contours.frames.size())
      file.fail(*node, fmt::format("'frame': {} has no such frame", path));
  } else if (contours.frames.size() > 1) {
    throw InputError(fmt::format("{}: {} frames; name one by 'frame' in {}", path,
                                 contours.frames.size(), file.path()));
  }
  const ContourFrame& frame = contours.frames[index];
  const Target target =
      make_target(model, contours.model_frame ? frame : registered(model, frame, to_model), noise);
  if (target.empty())
    throw InputError(fmt::format("{}: frame {} has no points", path, frame.number));
  return target;
}

Condition read_condition(const TomlReader& file, const toml::node& node, const Model& model,
                         double noise, double sd_percent, ContourFiles& files) {
  if (!node.is_table()) file.fail(node, "a [[condition]] must be a table");
  const toml::table& table = *node.as_table();
  file.only(table, condition_keys);
  Condition c;
  c.name = file.text(table, "name");
  c.target = read_target(file, table, model, noise, files);
  c.heldout = flag_or(file, table, "heldout", false);
  sd_percent = number_or(file, table, "force_sd_percent", sd_percent, 0);
  if (table.get("forces_N"))
    c.forces = known_forces(file, file.table(table, "forces_N"), sd_percent, model);
  if (table.get("effects"))
    for (const auto& [key, value] : file.table(table, "effects")) {
      const std::string where = fmt::format("{}:{}", file.path(), value.source().begin.line);
      c.effects[effect_parameter(std::string(key.str()), where)] =
          file.number(value, std::string(key.str()));
    }
  return c;
}

}  // namespace

ParameterName effect_parameter(const std::string& name, const std::string& source) {
  const auto whole = ParameterName::try_parse(name);
  const std::string effect = whole ? whole->effect : name;
  const EffectKind* kind = find_kind(effect);
  if (!kind || kind->always)
    throw InputError(fmt::format("{}: '{}' is no effect; did you mean {}?", source, effect,
                                 nearest_name(effect, effect_names())));
  if (whole) return *whole;
  if (kind->main.empty())
    throw InputError(
        fmt::format("{}: '{}' has several parameters; write {}.PARAMETER", source, name, name));
  return {effect, kind->main};
}

ModelDescription with_parameter(ModelDescription d, const ParameterName& name, double value) {
  if (!d.effects.contains(name.effect))
    for (const Hypothesis& h : hypotheses(d))
      if (h.effect == name.effect) {
        d = h.added_to(d);
        break;
      }
  d.effects[name.effect][name.key] = value;
  return d;
}

Observations read_observations(const std::string& path, const Model& model) {
  const TomlReader file(path);
  const toml::table& root = file.root();
  file.only(root, file_keys);
  Observations o;
  if (!root.get("noise_mm")) throw InputError(path + ": 'noise_mm' is missing");
  o.noise = 1e-3 * number_or(file, root, "noise_mm", 0, 1e-3);
  o.noise_correlation = 1e-3 * number_or(file, root, "noise_correlation_mm", 0, 0);
  o.bilateral = flag_or(file, root, "bilateral", true);
  o.effort_sd = number_or(file, root, "effort_sd", o.effort_sd, 1e-3);
  if (root.get("head_pose")) {
    const toml::table& pose = file.table(root, "head_pose");
    file.only(pose, {"shift_sd_mm", "turn_sd_deg"});
    o.head_pose =
        HeadPosePrior{1e-3 * number_or(file, pose, "shift_sd_mm", 1, 1e-3),
                      std::numbers::pi / 180 * number_or(file, pose, "turn_sd_deg", 1, 1e-3)};
  }
  const double sd_percent = number_or(file, root, "force_sd_percent", 0, 0);
  const auto* list = root.get("condition");
  if (!list || !list->is_array() || list->as_array()->empty())
    throw InputError(path + ": no [[condition]]");
  ContourFiles files(model, root.get("palate") ? beside(file, file.text(root, "palate")) : "");
  for (const toml::node& node : *list->as_array())
    o.conditions.push_back(read_condition(file, node, model, o.noise, sd_percent, files));
  if (std::all_of(o.conditions.begin(), o.conditions.end(),
                  [](const Condition& c) { return c.heldout; }))
    throw InputError(path + ": every condition is held out; some must be fitted");
  return o;
}

}  // namespace genio
