#pragma once
// How a motion follows the commands that drive it.

#include "forward/motion/dynamics.hpp"

namespace genio {

/// Controls of a motion: combinations of parameters, each linear in time between knots. Unknown
/// j * combinations.size() + c is combination c's value at knot j.
struct Controls {
  struct Share {
    int parameter;
    double amount;  ///< of the parameter for a value of 1
  };
  std::vector<std::vector<Share>> combinations;
  std::vector<double> knots;  ///< [s], rising from 0

  Eigen::Index unknowns() const {
    return Eigen::Index(combinations.size()) * Eigen::Index(knots.size());
  }
  /// The parameters over time; others stay at `base`.
  CommandsOverTime over_time(const Vector& values, const Parameters& base) const;
  /// Weight of each knot's value at a time.
  Vector weights(double time) const;
};

/// d positions / d unknowns at each of `times`, 3 n x unknowns: the exact derivative of the steps
/// that `trajectory` took (direct differentiation of the generalised-alpha scheme), shapes between
/// instants being linear in time. `start`: derivative of the first shape, which stays at rest;
/// without columns it does not move. Each step solves J S = right-hand sides with its own tangent
/// factorised; what viscous forces add through the shape is solved for to `accuracy` (gmres()).
/// Empty where a tangent is not positive definite or that does not converge. Throws InputError for
/// models with activation_dynamics, whose forces lag behind the commands, and for controls that are
/// modes of anatomy.
std::vector<Matrix> motion_sensitivity(const Model& given, const Controls& controls,
                                       const CommandsOverTime& commands,
                                       const Trajectory& trajectory, const TimeScheme& scheme,
                                       const Matrix& start, const std::vector<double>& times,
                                       Workspace& ws, double accuracy = 1e-4);

/// The shape at a time between the trajectory's instants [m].
Positions shape_at(const Trajectory& trajectory, double time);

}  // namespace genio
