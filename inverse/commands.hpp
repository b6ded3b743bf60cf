#pragma once
// The unknowns of an inversion: muscle commands, of each side or of both together.

#include <string>
#include <vector>

#include "forward/model.hpp"

namespace genio {

/// One unknown: a force shared over one or two muscle parameters.
struct Command {
  std::string name;             ///< "GGP" for both sides, "GGP_L" for one
  double max_force;             ///< [N]
  std::vector<int> parameters;  ///< model parameter indices
  std::vector<double> shares;   ///< part of the force each gets
};

/// All muscles of the model, in the model's order; `bilateral` joins left and right.
std::vector<Command> muscle_commands(const Model& model, bool bilateral);

/// Model parameters with the commands set to `activations` (force over maximum, 0 to 1).
Parameters apply_commands(const std::vector<Command>& commands, const Vector& activations,
                          Parameters parameters);

}  // namespace genio
