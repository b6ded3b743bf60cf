#include "cli/motion.hpp"

#include <fmt/format.h>

#include <chrono>

#include "forward/motion/dynamics.hpp"
#include "report/motion_report.hpp"

namespace genio::cli {
namespace {

CommandsOverTime commands_of(const Model& m, const ForwardOptions& o, const Parameters& rest) {
  if (o.small) throw InputError("--dynamic: not together with --small-deformation");
  if (!(o.ramp >= 0) || !(o.adapt_mm >= 0))
    throw InputError("--ramp and --adapt-mm: expected numbers of at least 0");
  if (!o.commands.empty() && (!o.forces.empty() || o.ramp > 0))
    throw InputError("--commands: not together with --force or --ramp");
  return o.commands.empty() ? ramp(rest, commanded(m, o.forces), o.ramp)
                            : read_commands(m, o.commands, rest);
}

nlohmann::json to_json(const Model& m, const Trajectory& t) {
  const Instant& last = t.instants.back();
  return {{"rise_time_s", rise_time(t, m.landmarks.tip)},
          {"volume_change_percent",
           100 * (mesh_volume(m.mesh, last.x) / mesh_volume(m.mesh, m.rest) - 1)},
          {"max_penetration_mm", 1e3 * t.max_penetration},
          {"energy_J", last.potential},
          {"kinetic_J", last.kinetic},
          {"dissipated_J", last.dissipated},
          {"work_J", last.work_done},
          {"landmarks", landmarks_json(m, last.x)}};
}

}  // namespace

void add_motion_options(CLI::App& app, ForwardOptions& o) {
  app.add_flag("--dynamic", o.dynamic, "Motion from rest instead of equilibrium");
  app.add_option("--duration", o.duration, "Length of the motion [s]")->capture_default_str();
  app.add_option("--step", o.step, "Time step [s], the longest where steps adapt")
      ->capture_default_str();
  app.add_option("--commands", o.commands, "CSV: time_s,GGP_N,... linear between rows");
  app.add_option("--ramp", o.ramp, "Time over which --force rises from nothing [s]; 0: a step")
      ->capture_default_str();
  app.add_option("--scheme", o.scheme, "Time integration")
      ->check(CLI::IsMember({"newmark", "generalised-alpha"}))
      ->capture_default_str();
  app.add_option("--spectral-radius", o.spectral_radius,
                 "generalised-alpha: what is left of the fastest waves after a step, 0 to 1")
      ->capture_default_str();
  app.add_option("--adapt-mm", o.adapt_mm, "Largest error of a step [mm]; 0: fixed steps")
      ->capture_default_str();
}

int run_motion(const Model& m, const ForwardOptions& o) {
  const Parameters rest = default_parameters(m);
  const CommandsOverTime commands = commands_of(m, o, rest);
  TimeOptions options;
  options.duration = o.duration, options.step = o.step, options.accuracy = 1e-3 * o.adapt_mm;
  options.scheme = o.scheme == "newmark" ? TimeScheme::newmark()
                                         : TimeScheme::generalised_alpha(o.spectral_radius);
  Workspace ws(m);
  const auto begin = std::chrono::steady_clock::now();
  // Whatever acts without commands has acted for ever.
  const Equilibrium start = solve_equilibrium(m, rest, m.rest, ws);
  Trajectory t;
  if (start) t = simulate(m, commands, start.x, ws, options);
  else t.message = "no equilibrium to start from: " + start.message;
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double reached = t.instants.empty() ? 0 : t.instants.back().time;
  nlohmann::json j = {{"status", t ? "converged" : "failed"},
                      {"message", t.message},
                      {"steps", std::max(0, int(t.instants.size()) - 1)},
                      {"rejected_steps", t.rejected},
                      {"simulated_s", reached},
                      {"newton_iterations", start.newton_iterations + t.newton_iterations},
                      {"factorizations", start.factorizations + t.factorizations},
                      {"wall_s", wall},
                      {"realtime_factor", reached > 0 ? wall / reached : 0}};
  if (t) j.update(to_json(m, t));
  if (!o.out.empty() && !t.instants.empty()) write_motion(m, t, o.out);
  if (o.json) {
    fmt::print("{}\n", j.dump());
  } else if (t) {
    fmt::print("{} steps, {:.0f} ms of motion in {:.2f} s ({} iterations, {} factorisations)\n",
               j["steps"].get<int>(), 1e3 * reached, wall, t.newton_iterations, t.factorizations);
    print_landmarks(j["landmarks"]);
    fmt::print("  tip's rise time {:.1f} ms, volume {:+.3f} %, deepest contact {:.3f} mm\n",
               1e3 * j["rise_time_s"].get<double>(), j["volume_change_percent"].get<double>(),
               1e3 * t.max_penetration);
  } else {
    fmt::print(stderr, "genio forward: {}\n", t.message);
  }
  return t ? done : no_answer;
}

}  // namespace genio::cli
