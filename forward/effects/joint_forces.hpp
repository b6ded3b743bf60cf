#pragma once
// Forces of a potential and a dissipation that share their work.

#include "forward/base/types.hpp"
#include "forward/effects/parameter.hpp"

namespace genio {

/// The force of an effect's potential and that of its dissipation in one pass. A model uses it in
/// motion instead of Potential::add_force and Dissipation::add_viscous_force, whose sum it equals.
class JointForces {
 public:
  virtual ~JointForces() = default;
  /// Adds -dE/dx to `f` and -dR/dv to `viscous` [N]. `p`: what the dissipation reads.
  virtual void add_forces(const Positions& x, const Vector& v, EffectParameters p, Forces& f,
                          Forces& viscous) const = 0;
};

}  // namespace genio
