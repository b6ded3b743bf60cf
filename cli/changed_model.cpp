#include <fmt/format.h>

#include "cli/motion.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"

namespace genio::cli {

Model changed_model(const ForwardOptions& o) {
  auto description = read_description(o.model);
  for (const auto& name : o.without)
    if (description.effects.erase(name) == 0)
      throw InputError(fmt::format("--without {}: the model has no such effect", name));
  bool kappa_given = false;
  for (const auto& text : o.effects) {
    const auto [name, value] = parse_assignment("--effect", text);
    if (name.find('.') == std::string::npos)
      throw InputError(fmt::format("--effect {}: expected NAME.parameter=VALUE", text));
    const auto [effect, key] = ParameterName::parse(name);
    if (effect == "muscles")
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
  return build_model(description, o.model);
}

Parameters commanded(const Model& model, const std::vector<std::string>& forces) {
  Parameters p = default_parameters(model);
  for (const auto& text : forces) {
    const auto [name, value] = parse_assignment("--force", text);
    set_command(model, name, value, p);
  }
  return p;
}

nlohmann::json landmarks_json(const Model& m, const Positions& x) {
  nlohmann::json j;
  for (const auto& [name, node] : {std::pair{"tip", m.landmarks.tip},
                                   {"dorsum", m.landmarks.dorsum},
                                   {"root", m.landmarks.root}}) {
    const Vec3 u = 1e3 * (node_position(x, node) - node_position(m.rest, node));
    j[name] = {{"dx_mm", u[0]}, {"dy_mm", u[1]}, {"dz_mm", u[2]}};
  }
  return j;
}

void print_landmarks(const nlohmann::json& j) {
  for (const char* name : {"tip", "dorsum", "root"})
    fmt::print("  {:<7} dx {:7.2f}  dy {:7.2f}  dz {:7.2f} mm\n", name,
               j[name]["dx_mm"].get<double>(), j[name]["dy_mm"].get<double>(),
               j[name]["dz_mm"].get<double>());
}

}  // namespace genio::cli
