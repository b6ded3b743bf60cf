#pragma once
// What subcommands print for programs, each one JSON object.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/landmarks.hpp"
#include "forward/model/model.hpp"
#include "genio/server_status_t.hpp"

namespace genio::cli {

/// What `genio forward` says of an equilibrium. Without a shape, `message` says why.
struct StaticsResult {
  struct Shape {
    double volume_change_percent, max_penetration_mm, energy_J;
    std::vector<LandmarkShift> landmarks;
  };
  std::string message;
  int newton_iterations, factorizations;
  double wall_s;
  std::map<std::string, double> anatomy;  ///< modes' values [sd]; displacements are from its rest
  std::optional<Shape> shape;
};

/// What `genio forward --dynamic` says of a motion. Without an end, `message` says why.
struct MotionResult {
  struct End {
    double rise_time_s;
    StaticsResult::Shape shape;  ///< its energy is the potential
    double kinetic_J, dissipated_J, work_J;
  };
  std::string message;
  int steps, rejected_steps;
  double simulated_s;
  int newton_iterations, factorizations;
  double wall_s;
  std::map<std::string, double> anatomy;  ///< as of an equilibrium
  std::optional<End> end;
};

/// Where a model comes from.
struct ModelOrigin {
  std::string provenance;                     ///< as its file states it
  std::map<std::string, std::string> hashes;  ///< SHA-256 of its files by their names
};
std::string info_json(const Model& model, double smallest_corner_jacobian_ratio,
                      const ModelOrigin& origin);
std::string statics_json(const StaticsResult& result);
std::string motion_json(const MotionResult& result);
/// `indent` -1: on one line.
std::string status_json(const server_status_t& status, int indent);

}  // namespace genio::cli
