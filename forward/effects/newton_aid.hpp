#pragma once
// What helps Newton's method with a stiff potential. It never changes an answer, only how fast
// Newton gets there.

#include "forward/algebra/stiffness.hpp"
#include "forward/base/types.hpp"
#include "forward/effects/parameter.hpp"

namespace genio {

/// The linearised step that led to a shape, and what it promised there.
struct LinearStep {
  const Positions& from;     ///< where the linearisation was made
  const Vector& step;        ///< nodal displacements, followed along a straight or a curved path
  const Vector& dilatation;  ///< each element's mean v/V - 1 as predicted for the shape
};

/// Reads the same parameters as the potential that it belongs to.
class NewtonAid {
 public:
  virtual ~NewtonAid() = default;
  /// Adds the stiffness that a Newton step from `x` should use when the step `led` led there
  /// [N/m]. It differs from the potential's only where a stiff constraint makes the force at x a
  /// poor guess of the force after the step. It equals that one when the step is zero and the
  /// dilatation is that of x.
  virtual void add_step_stiffness(const Positions& x, const LinearStep& led, EffectParameters p,
                                  Stiffness& k) const = 0;
  /// Largest fraction in (0, 1] of the step `along` from x over which the linearisation at x is
  /// still some guide.
  virtual double step_limit(const Positions& /*x*/, const Positions& /*along*/,
                            EffectParameters /*p*/) const {
    return 1.0;
  }
  /// Adds the bulk modulus that the potential gives each element [Pa].
  virtual void add_bulk_modulus(EffectParameters /*p*/, Vector& /*kappa*/) const {}
};

}  // namespace genio
