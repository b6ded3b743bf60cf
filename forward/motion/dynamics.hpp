#pragma once
// Motion: M a + C v + dPi/dx = 0 over time.

#include <functional>
#include <string>
#include <vector>

#include "forward/motion/commands_over_time.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio {

/// Which instant of a step the equation of motion is met at, and how displacement and velocity
/// follow from acceleration.
struct TimeScheme {
  double alpha_m = 0, alpha_f = 0;  ///< inertia at t_{n+1-alpha_m}, forces at t_{n+1-alpha_f}
  double beta = 0.25, gamma = 0.5;

  /// The trapezoidal rule (Newmark 1959): second order, no dissipation of its own.
  static TimeScheme newmark() { return {}; }
  /// Second order, waves too fast for the step shrink by `spectral_radius` each step (Chung &
  /// Hulbert 1993, eqs. 17 and 25); 0 to 1.
  static TimeScheme generalised_alpha(double spectral_radius);
};

struct TimeOptions {
  double duration = 0.12;  ///< [s]
  double step = 0.002;     ///< [s]; the longest one where steps adapt
  TimeScheme scheme = TimeScheme::generalised_alpha(0.5);
  double tolerance = 1e-6;  ///< residual of each step over the loads (at least 1 mN)
  /// Largest nodal error of a step [m], by Zienkiewicz & Xie (1991); 0: fixed steps.
  double accuracy = 0;
  std::function<void(double part)> progress = {};  ///< hears how far the motion is, 0 to 1
};

/// One instant.
struct Instant {
  double time;                   ///< [s]
  Positions x;                   ///< [m]
  Vector velocity;               ///< [m/s]
  Vector acceleration;           ///< [m/s^2]
  double kinetic, potential;     ///< [J]; the potential of everything that has one
  double dissipated, work_done;  ///< since the start [J]: by viscous forces, by changing parameters
};

struct Trajectory {
  SolveStatus status = SolveStatus::failed;
  std::string message;  ///< the reason of a failure; what was reached is there
  std::vector<Instant> instants;
  double max_penetration = 0;  ///< [m]
  int newton_iterations = 0;
  int factorizations = 0;
  int rejected = 0;  ///< steps tried again with half the length

  explicit operator bool() const { return status == SolveStatus::converged; }
};

/// Motion from rest in the shape `start`. Each step is solved by quasi-Newton iterations (BFGS,
/// Matthies & Strang 1979) on a factor that is renewed only when they get slow, over as many steps
/// as it will serve. The anatomy is that of the first instant; a start of another is carried() to
/// it.
Trajectory simulate(const Model& given, const CommandsOverTime& commands, const Positions& start,
                    Workspace& ws, const TimeOptions& options = {});

/// Time from 10 % to 90 % of the way of a node between the first and the last instant [s].
double rise_time(const Trajectory& trajectory, int node);

}  // namespace genio
