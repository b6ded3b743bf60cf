#pragma once
// One summand of what motion turns into heat. It acts in dynamics only.

#include "forward/algebra/stiffness.hpp"
#include "forward/base/types.hpp"
#include "forward/effects/term.hpp"

namespace genio {

/// Dissipation function R(x, v; p), its viscous force and damping, and how the force changes with
/// shape and parameters. x: nodal positions, 3 n [m]; v: nodal velocities, 3 n [m/s].
class Dissipation : public Term {
 public:
  /// R [W], convex in v. Here it is that of a viscous force linear in v.
  virtual double dissipation(const Positions& x, const Vector& v, EffectParameters p) const;
  /// Adds -dR/dv [N].
  virtual void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                                 Forces& f) const = 0;
  /// Adds d2R/dv2 [N s/m].
  virtual void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                           Stiffness& c) const = 0;
  /// Adds to each column of `df` the derivative of the viscous force along the same column of
  /// `along`, nodal displacements at fixed v [N per unit]. `scratch` may be overwritten. Here it is
  /// taken by differences.
  virtual void add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                                       const Matrix& along, Stiffness& scratch, Matrix& df) const;
  /// Adds the derivative of the viscous force with respect to parameter k [N per unit].
  virtual void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p,
                                            int k, Forces& df) const = 0;
};

}  // namespace genio
