#pragma once
// One summand of the potential energy. The statics of a tongue is a sum of these.

#include "forward/algebra/stiffness.hpp"
#include "forward/base/types.hpp"
#include "forward/effects/term.hpp"

namespace genio {

class NewtonAid;

/// Energy E(x; p), its force and stiffness, and how the force changes with each parameter.
/// x: nodal positions, 3 n [m]; p: see EffectParameters.
class Potential : public Term {
 public:
  /// E [J]; +infinity where tissue would be turned inside out.
  virtual double energy(const Positions& x, EffectParameters p) const = 0;
  /// Adds -dE/dx [N]. It is only called where the energy is finite.
  virtual void add_force(const Positions& x, EffectParameters p, Forces& f) const = 0;
  /// Adds d2E/dx2 [N/m].
  virtual void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const = 0;
  /// Adds the derivative of the force with respect to parameter k [N per unit].
  virtual void add_force_derivative(const Positions& x, EffectParameters p, int k,
                                    Forces& df) const = 0;

  /// What helps Newton's method with it; null: it needs no help.
  virtual const NewtonAid* newton_aid() const { return nullptr; }
};

}  // namespace genio
