#pragma once
#include "inverse/solver/nonlinear_program.hpp"

namespace genio {

/// What foretells an objective near a known point, and is minimised there by Ipopt.
class LocalModel : public NonlinearProgram {
 public:
  /// Where it is to be minimised.
  virtual void set_bounds(Vector lower, Vector upper) = 0;
  /// The known point.
  virtual const Vector& anchor() const = 0;
  /// Longest displacement of a node of any target for the step d [m].
  virtual double reach(const Vector& d) const = 0;
};

}  // namespace genio
