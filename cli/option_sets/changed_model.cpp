#include "cli/option_sets/changed_model.hpp"

#include <fmt/format.h>

#include <set>

#include "cli/support.hpp"
#include "forward/base/nearest_name.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/effect_kinds.hpp"
#include "forward/model/model_file.hpp"

namespace genio::cli {

namespace {

std::string nearest_effect(const ModelDescription& description, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [effect, table] : description.effects) names.push_back(effect);
  return nearest_name(name, names);
}

}  // namespace

ModelDescription changed_description(ModelDescription description, const ModelChanges& changes) {
  for (const auto& name : changes.without)
    if (description.effects.erase(name) == 0)
      throw InputError(fmt::format("--without {}: the model has no such effect; did you mean {}?",
                                   name, nearest_effect(description, name)));
  bool kappa_given = false;
  for (const auto& text : changes.effects) {
    const auto [name, value] = parse_assignment("--effect", text);
    const auto parsed = ParameterName::try_parse(name);
    if (!parsed) throw InputError(fmt::format("--effect {}: expected NAME.parameter=VALUE", text));
    const auto& [effect, key] = *parsed;
    if (const EffectKind* kind = find_kind(effect); kind && kind->always)
      throw InputError(fmt::format("--effect {}: give commands by --force", text));
    if (effect == "gravity" && !description.effects.contains(effect))
      description.effects[effect] = {{"x", 0}, {"y", 0}, {"z", 0}};
    auto& table = description.effects[effect];
    // Softer or stiffer tissue keeps its Poisson ratio unless told otherwise.
    kappa_given |= name == "elasticity.kappa";
    if (name == "elasticity.a10" && !kappa_given && table.contains("kappa") &&
        table.contains("a10"))
      table["kappa"] *= value / table["a10"];
    table[key] = value;
  }
  return description;
}

Model changed_model(const std::string& model, const ModelChanges& changes) {
  return build_model(changed_description(read_description(model), changes), model);
}

Parameters commanded(const Model& model, const std::vector<std::string>& forces) {
  Parameters p = default_parameters(model);
  std::set<std::string> given;
  for (const auto& text : forces) {
    const auto [name, value] = parse_assignment("--force", text);
    if (!given.insert(name).second)
      throw InputError(fmt::format("--force {}: {} was given already", text, name));
    set_command(model, name, value, p);
  }
  return p;
}

}  // namespace genio::cli
