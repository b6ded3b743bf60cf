#pragma once
// What `genio forward` shares between statics and dynamics.

#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "forward/model/model.hpp"

namespace genio::cli {

struct ForwardOptions {
  std::string model = default_model(), out, suite;
  std::vector<std::string> forces, effects, without;
  bool small = false, json = false;
  // Motion:
  bool dynamic = false;
  std::string commands, scheme = "generalised-alpha";
  double duration = 0.12, step = 0.002, ramp = 0, spectral_radius = 0.5, adapt_mm = 0;
};

/// The model with the effects that the command line leaves out, switches on or changes.
Model changed_model(const ForwardOptions& o);

/// Default parameters with the commands NAME=NEWTONS set.
Parameters commanded(const Model& model, const std::vector<std::string>& forces);

/// Displacements of tip, dorsum and root [mm].
nlohmann::json landmarks_json(const Model& model, const Positions& x);
void print_landmarks(const nlohmann::json& landmarks);

/// Declares the options of `--dynamic`.
void add_motion_options(CLI::App& app, ForwardOptions& o);

/// Simulates, prints and writes a motion.
int run_motion(const Model& model, const ForwardOptions& o);

}  // namespace genio::cli
