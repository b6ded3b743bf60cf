#pragma once
// Static equilibrium: the shape where the potential energy is stationary.

#include <string>

#include "forward/algebra/cholesky.hpp"
#include "forward/algebra/mixed_solver.hpp"
#include "forward/model/sums.hpp"
#include "forward/statics/curved_step.hpp"

namespace genio {

/// Scratch and factor of one solver: one a thread, reused from call to call. A factor left by an
/// earlier call serves as preconditioner of the next. It keeps what it needs of its model alive.
struct Workspace {
  explicit Workspace(const Model& model);
  /// Throws std::invalid_argument when it was made for another model.
  void check(const Model& model) const;

  Stiffness stiffness;
  ReducedStiffness reduced;
  Cholesky cholesky;
  MixedSolver mixed;
  CurvedStep curved;

  /// Factorises `stiffness` + shift I, which is that of the shape x. False where it is not positive
  /// definite.
  bool factorize(const Model& model, const Positions& x, const Parameters& p, double shift = 0);
};

struct SolveOptions {
  double tolerance = 1e-9;        ///< residual over the applied forces (at least 1 mN)
  int max_iterations = 100;       ///< Newton steps a load step
  int max_factorizations = 1000;  ///< gives up beyond
  int max_load_steps = 64;        ///< where one step from the start does not converge
};

enum class SolveStatus { converged, failed };

struct Equilibrium {
  SolveStatus status = SolveStatus::failed;
  std::string message;  ///< the reason of a failure
  Positions x;          ///< [m]
  Parameters parameters;
  double energy = 0;    ///< [J]
  double residual = 0;  ///< relative, as in SolveOptions::tolerance
  int newton_iterations = 0;
  int factorizations = 0;
  int load_steps = 0;

  explicit operator bool() const { return status == SolveStatus::converged; }
};

/// Newton from `start`. Each stage takes away a part of the unbalanced force (all of it when near)
/// by steps whose linear systems are solved on the last factor with pressures as unknowns of their
/// own (MixedSolver), which is renewed only when that takes long. A step must lower the potential
/// or its energy-norm residual, is shortened until it does, and never turns tissue inside out; long
/// ones are curved (CurvedStep). Where the tangent is indefinite, a stage minimises the potential
/// plus springs to the shape it began at, weaker from stage to stage. Far from equilibrium contact
/// is softer at first. Where all this fails from `start`, muscle commands and weight are brought up
/// from the rest shape in steps. A start of another anatomy is carried() to that of p.
Equilibrium solve_equilibrium(const Model& model, const Parameters& p, const Positions& start,
                              Workspace& ws, const SolveOptions& options = {});

/// Small-deformation framework (Gerard, Perrier & Payan, section 5.1): x = rest + K0^-1 f by one
/// linear solve, 3 n [m]. K0 is the stiffness of the rest shape without loads [N/m]; f are all
/// nodal forces there, of commands, gravity and other loads [N]. A contact takes part only where it
/// presses at rest already. Turned parts swell, since a linear strain takes a turn for a stretch.
/// `residual` is that of the linear system, 0. The energy is infinite where tissue is inside out. A
/// status tells of parameters that are not finite and of a K0 that is not positive definite.
Equilibrium solve_small_deformation(const Model& given, const Parameters& p, Workspace& ws);

}  // namespace genio
