#pragma once
// Minimising an objective of commands in [0, 1]. The solver behind it stays behind it.

#include <string>

#include "inverse/objective.hpp"

namespace genio {

struct OptimiserResult {
  bool converged = false;
  std::string message;  ///< what the solver said when it did not converge
  Vector activations;   ///< best point seen
  int iterations = 0;
};

/// Ipopt with exact gradient and Gauss-Newton Hessian. `warm`: `start` is thought to be near.
/// Ipopt with MUMPS is not thread-safe: calls of one process take turns.
OptimiserResult minimise(Objective& objective, const Vector& start, bool warm,
                         const InferOptions& options);

}  // namespace genio
