#include "cli/motion.hpp"

#include <fmt/format.h>

#include <functional>

#include "cli/landmarks.hpp"
#include "cli/option_sets/changed_model.hpp"
#include "cli/result_json.hpp"
#include "forward/base/elapsed.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/motion/dynamics.hpp"
#include "report/answers/motion_report.hpp"
#include "runs/process/progress_line.hpp"

namespace genio::cli {
namespace {

CommandsOverTime commands_of(const Model& m, const SimulationOptions& o, const Parameters& rest) {
  if (!(o.ramp >= 0) || !(o.adapt_mm >= 0))
    throw InputError("--ramp and --adapt-mm: expected numbers of at least 0");
  if (o.ramp > 0 && o.forces.empty())
    throw InputError("--ramp: does nothing without --force, which it lets rise");
  return o.commands.empty() ? ramp(rest, commanded(m, o.forces), o.ramp)
                            : read_commands(m, o.commands, rest);
}

MotionResult::End end_of(const Model& m, const Trajectory& t) {
  const Instant& last = t.instants.back();
  return {.rise_time_s = rise_time(t, m.landmarks.tip),
          .shape = {.volume_change_percent =
                        100 * (mesh_volume(m.mesh, last.x) / mesh_volume(m.mesh, m.rest) - 1),
                    .max_penetration_mm = 1e3 * t.max_penetration,
                    .energy_J = last.potential,
                    .landmarks = landmark_shifts(m, last.x)},
          .kinetic_J = last.kinetic,
          .dissipated_J = last.dissipated,
          .work_J = last.work_done};
}

void print_motion(const MotionResult& r, int iterations, int factorizations) {
  const StaticsResult::Shape& shape = r.end->shape;
  fmt::print("{} steps, {:.0f} ms of motion in {:.2f} s ({} iterations, {} factorisations)\n",
             r.steps, 1e3 * r.simulated_s, r.wall_s, iterations, factorizations);
  print_anatomy(r.anatomy);
  print_landmarks(shape.landmarks);
  fmt::print("  tip's rise time {:.1f} ms, volume {:+.3f} %, deepest contact {:.3f} mm\n",
             1e3 * r.end->rise_time_s, shape.volume_change_percent, shape.max_penetration_mm);
}

}  // namespace

void add_motion_options(Options& options, SimulationOptions& o) {
  const Rules moving{.shows_default = true, .only_with = {"--dynamic"}};
  options.add("--duration", o.duration, "Length of the motion [s]", moving);
  options.add("--step", o.step, "Time step [s], the longest where steps adapt", moving);
  options.add("--commands", o.commands, "CSV: time_s,GGP_N,... linear between rows",
              {.only_with = {"--dynamic"}, .not_with = {"--force", "--ramp"}});
  options.add("--ramp", o.ramp, "Time over which --force rises from nothing [s]; 0: a step",
              moving);
  options.add("--scheme", o.scheme, "Time integration",
              {.shows_default = true,
               .among = {"newmark", "generalised-alpha"},
               .only_with = {"--dynamic"}});
  options.add("--spectral-radius", o.spectral_radius,
              "generalised-alpha: what is left of the fastest waves after a step, 0 to 1", moving);
  options.add("--adapt-mm", o.adapt_mm, "Largest error of a step [mm]; 0: fixed steps", moving);
}

int run_motion(const Model& m, const SimulationOptions& o, const std::string& out, bool json) {
  const Parameters rest = default_parameters(m);
  const CommandsOverTime commands = commands_of(m, o, rest);
  if (o.scheme == "newmark" && o.spectral_radius_given)
    throw InputError("--spectral-radius: does not apply; --scheme newmark has none");
  TimeOptions options;
  options.duration = o.duration, options.step = o.step, options.accuracy = 1e-3 * o.adapt_mm;
  options.scheme = o.scheme == "newmark" ? TimeScheme::newmark()
                                         : TimeScheme::generalised_alpha(o.spectral_radius);
  LongWork progress("of the motion");
  options.progress = std::ref(progress);
  Workspace ws(m);
  const Stopwatch watch;
  // Whatever acts without commands has acted for ever.
  const Equilibrium start = solve_equilibrium(m, rest, m.rest, ws);
  Trajectory t;
  if (start) t = simulate(m, commands, start.x, ws, options);
  else t.message = "no equilibrium to start from: " + start.message;
  MotionResult result{.message = t.message,
                      .steps = std::max(0, int(t.instants.size()) - 1),
                      .rejected_steps = t.rejected,
                      .simulated_s = t.instants.empty() ? 0 : t.instants.back().time,
                      .newton_iterations = start.newton_iterations + t.newton_iterations,
                      .factorizations = start.factorizations + t.factorizations,
                      .wall_s = watch.seconds(),
                      .anatomy = anatomy_values(m, rest),
                      .end = {}};
  if (t) result.end = end_of(m, t);
  if (!out.empty() && !t.instants.empty()) write_motion(m, t, out);
  if (json) fmt::print("{}\n", motion_json(result));
  else if (t) print_motion(result, t.newton_iterations, t.factorizations);
  else fmt::print(stderr, "genio forward: {}\n", t.message);
  return t ? done : no_answer;
}

}  // namespace genio::cli
