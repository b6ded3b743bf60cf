#include "cli/subcommands/forward.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/landmarks.hpp"
#include "cli/motion.hpp"
#include "cli/option_sets/changed_model.hpp"
#include "cli/result_json.hpp"
#include "cli/run_bench.hpp"
#include "cli/support.hpp"
#include "forward/base/elapsed.hpp"
#include "forward/base/text_file.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/model_file.hpp"
#include "forward/statics/equilibrium.hpp"
#include "report/answers/motion_report.hpp"

namespace genio::cli {
namespace {

struct ForwardOptions {
  std::string model = default_model(), out, suite;
  ModelChanges changes;
  SimulationOptions motion;
  bool small = false, dynamic = false, json = false;
};

/// Published results on this tongue: a benchmark's work.
int run_suite(const ForwardOptions& o) {
  std::vector<std::string> arguments = {o.suite, "--model", o.model};
  if (!o.out.empty()) arguments.insert(arguments.end(), {"--out", o.out});
  if (o.json) arguments.push_back("--json");
  run_bench(arguments);
}

void print_statics(const StaticsResult& r) {
  fmt::print("equilibrium in {} Newton steps, {} factorisations, {:.2f} s\n", r.newton_iterations,
             r.factorizations, r.wall_s);
  print_anatomy(r.anatomy);
  print_landmarks(r.shape->landmarks);
  fmt::print("  volume {:+.3f} %, deepest contact {:.3f} mm\n", r.shape->volume_change_percent,
             r.shape->max_penetration_mm);
}

int run_statics(const Model& m, const ForwardOptions& o) {
  const Parameters p = commanded(m, o.motion.forces);
  Workspace ws(m);
  const Stopwatch watch;
  const Equilibrium e =
      o.small ? solve_small_deformation(m, p, ws) : solve_equilibrium(m, p, m.rest, ws);
  StaticsResult result{.message = e.message,
                       .newton_iterations = e.newton_iterations,
                       .factorizations = e.factorizations,
                       .wall_s = watch.seconds(),
                       .anatomy = anatomy_values(m, p),
                       .shape = {}};
  if (e)
    result.shape = StaticsResult::Shape{
        .volume_change_percent = 100 * (mesh_volume(m.mesh, e.x) / mesh_volume(m.mesh, m.rest) - 1),
        .max_penetration_mm = 1e3 * max_penetration(m, e.x, e.parameters),
        .energy_J = e.energy,
        .landmarks = landmark_shifts(m, e.x)};
  if (o.json) fmt::print("{}\n", statics_json(result));
  else if (e) print_statics(result);
  else fmt::print(stderr, "genio forward: {}\n", e.message);
  if (e && !o.out.empty()) {
    make_folder(o.out);
    write_shape(m, e.x, (std::filesystem::path(o.out) / "shape.vtu").string());
  }
  return e ? done : no_answer;
}

int run(const ForwardOptions& o) {
  if (!o.suite.empty()) return run_suite(o);
  const Model changed = changed_model(o.model, o.changes);
  const auto here = at_anatomy(changed);  // displacements are from the rest of that anatomy
  const Model& m = *here;
  if (!o.dynamic) return run_statics(m, o);
  return run_motion(m, o.motion, o.out, o.json);
}

}  // namespace

Runner add_forward(Options& options) {
  auto o = std::make_shared<ForwardOptions>();
  options.add("--model", o->model, "Model folder or model.toml");
  options.add("--force", o->motion.forces, "NAME=NEWTONS, whole muscle for a bilateral name");
  options.add("--effect", o->changes.effects, "NAME.param=VALUE, SI units");
  options.add("--without", o->changes.without, "Leave an effect of the model out");
  options.flag("--small-deformation", o->small, "Linear framework of the rest shape",
               {.not_with = {"--dynamic"}});
  options.add(
      "--suite", o->suite, "seed: the published results, on this tongue",
      {.among = {"seed"},
       .not_with = {"--force", "--effect", "--without", "--small-deformation", "--dynamic"}});
  options.flag("--dynamic", o->dynamic, "Motion from rest instead of equilibrium");
  add_motion_options(options, o->motion);
  options.flag("--json", o->json, "One JSON object on standard output");
  options.add("--out", o->out, "Folder for shape.vtu, or motion.pvd and landmarks.csv");
  options.footer(
      "Examples: genio forward --force GGP=4 --force TRANS=0.2 --out shape\n"
      "          genio forward --dynamic --force GGP=4 --duration 0.12 --step 0.002 --out motion");
  return [o, options] {
    o->motion.spectral_radius_given = options.given("--spectral-radius");
    return run(*o);
  };
}

}  // namespace genio::cli
