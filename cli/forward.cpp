#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "forward/equilibrium.hpp"
#include "forward/model_file.hpp"
#include "report/answer_report.hpp"

namespace genio::cli {
namespace {

struct ForwardOptions {
  std::string model = default_model(), out;
  std::vector<std::string> forces, effects, without;
  bool small = false, json = false;
};

nlohmann::json landmark(const Model& m, const Equilibrium& e, int node) {
  const Vec3 u = 1e3 * (node_position(e.x, node) - node_position(m.rest, node));
  return {{"dx_mm", u[0]}, {"dy_mm", u[1]}, {"dz_mm", u[2]}};
}

int run(const ForwardOptions& o) {
  auto description = read_description(o.model);
  for (const auto& name : o.without)
    if (description.effects.erase(name) == 0)
      throw InputError(fmt::format("--without {}: the model has no such effect", name));
  // An effect set on the command line is switched on.
  for (const auto& text : o.effects) {
    const auto name = parse_assignment("--effect", text).first;
    const auto effect = name.substr(0, name.find('.'));
    const auto& known = effect_names();
    if (effect != "muscles" && std::find(known.begin(), known.end(), effect) != known.end() &&
        !description.effects.contains(effect))
      description.effects[effect] =
          effect == "gravity" ? EffectTable{{"x", 0}, {"y", 0}, {"z", 0}} : EffectTable{};
  }
  const Model m = build_model(description, o.model);
  Parameters p = default_parameters(m);
  bool kappa_given = false;
  for (const auto& text : o.effects) {
    const auto [name, value] = parse_assignment("--effect", text);
    set_parameter(m, name, value, p);
    kappa_given |= name == "elasticity.kappa";
  }
  // Softer or stiffer tissue keeps its Poisson ratio unless told otherwise.
  if (!kappa_given) {
    const int a10 = parameter_index(m, "elasticity.a10"),
              kappa = parameter_index(m, "elasticity.kappa");
    p[kappa] *= p[a10] / m.parameters[a10].info.value;
  }
  for (const auto& text : o.forces) {
    const auto [name, value] = parse_assignment("--force", text);
    set_command(m, name, value, p);
  }
  Workspace ws(m);
  const auto start = std::chrono::steady_clock::now();
  const Equilibrium e =
      o.small ? solve_small_deformation(m, p, ws) : solve_equilibrium(m, p, m.rest, ws);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  nlohmann::json j = {{"status", e ? "converged" : "failed"},
                      {"message", e.message},
                      {"newton_iterations", e.newton_iterations},
                      {"factorizations", e.factorizations},
                      {"wall_s", wall}};
  if (e) {
    j["volume_change_percent"] = 100 * (mesh_volume(m.mesh, e.x) / mesh_volume(m.mesh, m.rest) - 1);
    j["max_penetration_mm"] = 1e3 * max_penetration(m, e.x, e.parameters);
    j["energy_J"] = e.energy;
    j["landmarks"] = {{"tip", landmark(m, e, m.landmarks.tip)},
                      {"dorsum", landmark(m, e, m.landmarks.dorsum)},
                      {"root", landmark(m, e, m.landmarks.root)}};
  }
  if (o.json) fmt::print("{}\n", j.dump());
  else if (e) {
    fmt::print("equilibrium in {} Newton steps, {} factorisations, {:.2f} s\n", e.newton_iterations,
               e.factorizations, wall);
    for (const char* name : {"tip", "dorsum", "root"})
      fmt::print("  {:<7} dx {:7.2f}  dy {:7.2f}  dz {:7.2f} mm\n", name,
                 j["landmarks"][name]["dx_mm"].get<double>(),
                 j["landmarks"][name]["dy_mm"].get<double>(),
                 j["landmarks"][name]["dz_mm"].get<double>());
    fmt::print("  volume {:+.3f} %, deepest contact {:.3f} mm\n",
               j["volume_change_percent"].get<double>(), j["max_penetration_mm"].get<double>());
  } else {
    fmt::print(stderr, "genio forward: {}\n", e.message);
  }
  if (e && !o.out.empty()) {
    std::filesystem::create_directories(o.out);
    write_shape(m, e.x, (std::filesystem::path(o.out) / "shape.vtu").string());
  }
  return e ? done : no_answer;
}

}  // namespace

Runner add_forward(CLI::App& app) {
  auto o = std::make_shared<ForwardOptions>();
  app.add_option("--model", o->model, "Model folder or model.toml");
  app.add_option("--force", o->forces, "NAME=NEWTONS, whole muscle for a bilateral name");
  app.add_option("--effect", o->effects, "NAME.param=VALUE, SI units");
  app.add_option("--without", o->without, "Leave an effect of the model out");
  app.add_flag("--small-deformation", o->small, "Linear framework of the rest shape");
  app.add_flag("--json", o->json, "One JSON object on standard output");
  app.add_option("--out", o->out, "Folder for shape.vtu");
  app.footer("Example: genio forward --force GGP=4 --force TRANS=0.2 --out shape");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
