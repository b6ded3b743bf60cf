#include "cli/option_sets/inversion_options.hpp"

#include "cli/option_sets/measured_options.hpp"
#include "cli/support.hpp"

namespace genio::cli {

void add_shape_options(Options& options, InversionOptions& o) {
  o.model = default_model();
  options.add("--model", o.model, "Model folder or model.toml");
  add_measured_options(options, o.measured);
  options.add("--prior", o.prior, "What is believed before: TOML, or a CSV of EMG");
  options.add("--starts", o.starts,
              "Descents a frame; more find other answers that fit (0: until the shape is "
              "explained)",
              {.range = {{0, 1000}}, .not_with = {"--dynamic"}});
  options.flag("--robust", o.robust, "Noise with outliers (Student's t)");
  options.flag("--bilateral", o.bilateral, "Left and right together");
}

void add_inversion_options(Options& options, InversionOptions& o) {
  add_shape_options(options, o);
  options.flag("--sequence", o.sequence, "Activations walk from frame to frame",
               {.not_with = {"--smooth", "--dynamic"}});
  options.flag("--smooth", o.smooth, "The same, all frames as one smoothing problem",
               {.not_with = {"--sequence", "--dynamic"}});
  options.flag("--dynamic", o.dynamic, "All frames as one movement, with inertia and viscosity");
  options.add("--knot-s", o.movement.knot_s, "--dynamic: between bends of the commands [s]",
              {.shows_default = true, .only_with = {"--dynamic"}});
  options.add("--step-s", o.movement.step_s, "--dynamic: time step [s]",
              {.shows_default = true, .only_with = {"--dynamic"}});
  options.add("--start-s", o.movement.start_s,
              "--dynamic: when the movement starts [s] (0.1 s before the first frame)",
              {.only_with = {"--dynamic"}});
  options.flag("--from-rest", o.movement.from_rest,
               "--dynamic: starts without commands; else from a posture that is found along",
               {.only_with = {"--dynamic"}});
  options.flag("--full-space", o.full_space,
               "Positions and commands together as unknowns: slower, to check the default by",
               {.not_with = {"--smooth", "--dynamic"}});
  options.add("--deadline-s", o.deadline_s, "Time a frame may take", {.positive = true});
}

}  // namespace genio::cli
