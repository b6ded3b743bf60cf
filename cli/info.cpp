#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "forward/anatomy/import_grenoble.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"

namespace genio::cli {

Runner add_info(CLI::App& app) {
  auto model = std::make_shared<std::string>(default_model());
  auto json = std::make_shared<bool>(false);
  app.add_option("--model", *model, "Model folder or model.toml");
  app.add_flag("--json", *json, "One JSON object on standard output");
  app.footer("Example: genio info --json");
  return [=]() -> int {
    const Model m = read_model(*model);
    double ratio = 1;
    for (size_t e = 0; e < m.mesh.elements.size(); ++e)
      ratio = std::min(ratio, corner_jacobian_ratio(m.mesh, int(e)));
    nlohmann::json j = {{"name", m.name},
                        {"nodes", m.mesh.nodes.size()},
                        {"elements", m.mesh.elements.size()},
                        {"volume_cm3", 1e6 * mesh_volume(m.mesh, m.rest)},
                        {"min_corner_jacobian_ratio", ratio}};
    for (const auto& muscle : m.muscles)
      j["muscles"][muscle.name]["max_force_N"] = muscle.max_force;
    for (const auto& p : m.parameters)
      j["effects"][p.name.effect][p.name.key] = {{"value", p.info.value},
                                                 {"unit", p.info.unit},
                                                 {"lower", p.info.lower},
                                                 {"upper", p.info.upper}};
    if (*json) {
      fmt::print("{}\n", j.dump());
      return done;
    }
    fmt::print("{}\n  {} nodes, {} elements, {:.2f} cm^3, smallest corner-Jacobian ratio {:.4f}\n",
               m.name, m.mesh.nodes.size(), m.mesh.elements.size(),
               1e6 * mesh_volume(m.mesh, m.rest), ratio);
    for (const auto& muscle : m.muscles)
      fmt::print("  {:<8} {:6.2f} N, {} fibres\n", muscle.name, muscle.max_force,
                 muscle.fibres.size());
    for (const auto& p : m.parameters)
      if (!p.is_command) fmt::print("  {} = {} {}\n", p.name.text(), p.info.value, p.info.unit);
    return done;
  };
}

Runner add_import(CLI::App& app) {
  auto kind = std::make_shared<std::string>();
  auto from = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  app.add_option("kind", *kind, "grenoble")->required();
  app.add_option("folder", *from, "Folder with tongue/ and surfaces_icp_m/")->required();
  app.add_option("--out", *out, "Model folder to write")->required();
  app.footer("Example: genio import grenoble path/to/grenoble --out grenoble");
  return [=]() -> int {
    if (*kind != "grenoble")
      throw InputError(fmt::format("import {}: unknown; did you mean grenoble?", *kind));
    const auto description = import_grenoble(*from);
    build_model(description, *from);  // refuses what could not be computed with
    write_description(description, *out);
    fmt::print(stderr, "{}: {} nodes, {} elements, {} muscles\n", *out,
               description.mesh.nodes.size(), description.mesh.elements.size(),
               description.muscles.size());
    return done;
  };
}

}  // namespace genio::cli
