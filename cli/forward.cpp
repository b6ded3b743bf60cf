#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "cli/motion.hpp"
#include "cli/run_bench.hpp"
#include "forward/model/model_file.hpp"
#include "forward/statics/equilibrium.hpp"
#include "report/motion_report.hpp"

namespace genio::cli {
namespace {

/// Published results on this tongue: a benchmark's work.
int run_suite(const ForwardOptions& o) {
  std::vector<std::string> arguments = {o.suite, "--model", o.model};
  if (!o.out.empty()) arguments.insert(arguments.end(), {"--out", o.out});
  if (o.json) arguments.push_back("--json");
  run_bench(arguments);
}

int run(const ForwardOptions& o) {
  if (!o.suite.empty()) return run_suite(o);
  const Model m = changed_model(o);
  if (o.dynamic) return run_motion(m, o);
  const Parameters p = commanded(m, o.forces);
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
    j["landmarks"] = landmarks_json(m, e.x);
  }
  if (o.json) fmt::print("{}\n", j.dump());
  else if (e) {
    fmt::print("equilibrium in {} Newton steps, {} factorisations, {:.2f} s\n", e.newton_iterations,
               e.factorizations, wall);
    print_landmarks(j["landmarks"]);
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
  app.add_option("--suite", o->suite, "seed: the published results, on this tongue")
      ->check(CLI::IsMember({"seed"}));
  add_motion_options(app, *o);
  app.add_flag("--json", o->json, "One JSON object on standard output");
  app.add_option("--out", o->out, "Folder for shape.vtu, or motion.pvd and landmarks.csv");
  app.footer(
      "Examples: genio forward --force GGP=4 --force TRANS=0.2 --out shape\n"
      "          genio forward --dynamic --force GGP=4 --duration 0.12 --step 0.002 --out motion");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
