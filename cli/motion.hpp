#pragma once
// `genio forward --dynamic`.

#include <string>
#include <vector>

#include "cli/command_line/options.hpp"
#include "forward/model/model.hpp"

namespace genio::cli {

struct SimulationOptions {
  std::vector<std::string> forces;  ///< "NAME=NEWTONS"
  std::string commands, scheme = "generalised-alpha";
  bool spectral_radius_given = false;
  double duration = 0.12, step = 0.002, ramp = 0, spectral_radius = 0.5, adapt_mm = 0;
};

/// Declares what only a motion has: all but --force.
void add_motion_options(Options& options, SimulationOptions& o);

/// Simulates and prints a motion, as JSON or for people; writes it into the folder `out`, unless
/// that is empty.
int run_motion(const Model& model, const SimulationOptions& o, const std::string& out, bool json);

}  // namespace genio::cli
