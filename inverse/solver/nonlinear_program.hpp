#pragma once
// A constrained minimisation as every problem here states it. The solver stays behind solve().

#include <span>
#include <utility>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// Minimise f(v) over lower <= v <= upper with c(v) = 0. Evaluations return false where the
/// function does not exist; the solver then shortens its step.
class NonlinearProgram {
 public:
  /// Row and column of each entry of a sparse matrix.
  using Entries = std::vector<std::pair<int, int>>;

  virtual ~NonlinearProgram() = default;
  virtual const Vector& lower() const = 0;
  virtual const Vector& upper() const = 0;
  virtual bool value(const Vector& v, double& f) = 0;
  virtual bool gradient(const Vector& v, Vector& g) = 0;
  /// Lower triangle of the Hessian of the Lagrangian factor f + multipliers . c; empty: the solver
  /// is to learn it from the gradients.
  virtual Entries hessian_entries() const { return {}; }
  virtual bool hessian(const Vector& /*v*/, double /*factor*/, const Vector& /*multipliers*/,
                       std::span<double> /*values*/) {
    return false;
  }
  virtual int constraints() const { return 0; }
  virtual bool constraint_values(const Vector& /*v*/, Vector& /*c*/) { return true; }
  virtual Entries jacobian_entries() const { return {}; }
  virtual bool jacobian(const Vector& /*v*/, std::span<double> /*values*/) { return true; }
  /// Asked after each iteration; false ends the work.
  virtual bool go_on(int /*iteration*/) { return true; }
};

struct ProgramOptions {
  int max_iterations = 60;
  double tolerance = 1e-6;
  double barrier = 1e-3;  ///< first parameter of the barrier
  double push = 1e-4;     ///< how far the start is moved off the bounds
  /// Reduction of the barrier parameter from one value to the next.
  double barrier_decrease = 0.1;
  /// A barrier problem counts as solved at this many times its parameter; large: the barrier is
  /// only a way to the bounds, hurry along it.
  double barrier_tolerance = 10;
};

struct ProgramResult {
  bool solved = false;
  int status = 0;  ///< the solver's own code
  Vector v;        ///< where it ended
  Vector lower_multipliers, upper_multipliers, multipliers;
  int iterations = 0;
};

/// By Ipopt (Waechter & Biegler 2006). Its linear solver MUMPS is not thread-safe: calls of one
/// process take turns.
ProgramResult solve(NonlinearProgram& program, const Vector& start,
                    const ProgramOptions& options = {});

}  // namespace genio
