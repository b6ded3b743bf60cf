#pragma once
// One summand of the potential energy. The whole model is a sum of these.

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "forward/algebra/stiffness.hpp"
#include "forward/base/types.hpp"

namespace genio {

/// What an effect lets you vary.
struct ParameterInfo {
  std::string name;  ///< "GGP_L", "a10", "z"
  std::string unit;  ///< "N", "Pa", "m/s^2"
  double value = 0;  ///< value in the model as read
  double lower = 0;  ///< bounds
  double upper = 0;
  double absent = 0;     ///< value at which what it stands for vanishes
  bool load = false;     ///< drives the shape away from rest; continuation brings it up from absent
  bool penalty = false;  ///< enforces a constraint; a far solve starts with a softer one
  /// How far from `absent` it tends to be where what it stands for is there; 0: nobody asks whether
  /// it is. What a search for missing effects believes of it before it sees data.
  double typical = 0;
  /// Says where or how large, and counts only where some strength of its effect is off its absent
  /// value; `typical` is then how uncertain it is.
  bool detail = false;
  /// Within the bounds, where it is ever found where what it stands for is there.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  /// A factor, 1 where absent: what is believed of it, `typical` too, is of its logarithm.
  bool ratio = false;

  /// How far a value is from `absent`, in the terms of `typical`; and the value so far off.
  double off(double value_) const { return ratio ? std::log(value_) : value_ - absent; }
  double at(double off_) const { return ratio ? std::exp(off_) : absent + off_; }
};

/// One way in which an effect may show: numbers let off their absent values at once.
struct Strength {
  std::string where;  ///< "GGP_L"; empty where the effect has but one way
  /// Of each number, the parameters that take its value.
  std::vector<std::vector<int>> numbers;
};

/// Values of one effect's parameters, in the order of Effect::parameters(), then of those it
/// borrows.
using EffectParameters = std::span<const double>;

/// The linearised step that led to a shape, and what it promised there.
struct LinearStep {
  const Positions& from;     ///< where the linearisation was made
  const Vector& step;        ///< nodal displacements, followed along a straight or a curved path
  const Vector& dilatation;  ///< each element's mean v/V - 1 as predicted for the shape
};

/// Energy, force and stiffness of one effect, and how its force changes with its parameters.
/// Const and without scratch: one object serves any number of threads.
class Effect {
 public:
  virtual ~Effect() = default;
  virtual std::string_view name() const = 0;
  virtual std::span<const ParameterInfo> parameters() const = 0;
  /// Parameters of other effects that this one reads ("muscles.GGP_L"). Their values follow its
  /// own, and add_force_derivative() is asked for them by their place there too.
  virtual std::vector<std::string> borrows() const { return {}; }

  /// The ways in which it may be what a model lacks. Here: each parameter that has a typical value
  /// and is no detail, by itself.
  virtual std::vector<Strength> strengths() const;
  /// What is never met about such values, alone or together, as an end to "it would ..."; empty:
  /// nothing. Nobody names an effect with them.
  virtual std::string implausible(EffectParameters /*p*/) const { return {}; }

  /// Potential energy [J]; +infinity where tissue would be turned inside out.
  virtual double energy(const Positions& x, EffectParameters p) const = 0;
  /// Adds -dE/dx [N]. Only called where the energy is finite.
  virtual void add_force(const Positions& x, EffectParameters p, Forces& f) const = 0;
  /// Adds d2E/dx2 [N/m].
  virtual void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const = 0;
  /// Adds the stiffness a Newton step from `x` should use when the step `led` led there. Differs
  /// from add_stiffness only where a stiff constraint makes the force at x a poor guess of the
  /// force after the step; equal to it when the step is zero and the dilatation that of x.
  virtual void add_step_stiffness(const Positions& x, const LinearStep& /*led*/, EffectParameters p,
                                  Stiffness& k) const {
    add_stiffness(x, p, k);
  }
  /// Adds the derivative of the force with respect to parameter k [N per unit].
  virtual void add_force_derivative(const Positions& x, EffectParameters p, int k,
                                    Forces& df) const = 0;
  /// Adds the bulk modulus this effect gives each element [Pa].
  virtual void add_bulk_modulus(EffectParameters /*p*/, Vector& /*kappa*/) const {}
  /// Largest fraction in (0, 1] of the step `along` from x over which the linearisation at x is
  /// still some guide.
  virtual double step_limit(const Positions& /*x*/, const Positions& /*along*/,
                            EffectParameters /*p*/) const {
    return 1.0;
  }

  /// Dissipation function R of the nodal velocities v in the shape x [W]; convex in v. Here that of
  /// a viscous force linear in v.
  virtual double dissipation(const Positions& x, const Vector& v, EffectParameters p) const {
    Forces f = Forces::Zero(x.size());
    add_viscous_force(x, v, p, f);
    return -0.5 * f.dot(v);
  }
  /// Adds -dR/dv [N].
  virtual void add_viscous_force(const Positions& /*x*/, const Vector& /*v*/,
                                 EffectParameters /*p*/, Forces& /*f*/) const {}
  /// Adds d2R/dv2 [N s/m].
  virtual void add_damping(const Positions& /*x*/, const Vector& /*v*/, EffectParameters /*p*/,
                           Stiffness& /*c*/) const {}
  /// Adds to each column of `df` the derivative of the viscous force along the same column of
  /// `along`, nodal displacements at fixed v [N per unit]. `scratch` may be overwritten. Here by
  /// differences.
  virtual void add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                                       const Matrix& along, Stiffness& scratch, Matrix& df) const;
  /// add_force and add_viscous_force at once, for effects that can share work between them.
  virtual void add_forces_in_motion(const Positions& x, const Vector& v, EffectParameters p,
                                    Forces& f, Forces& viscous) const {
    add_force(x, p, f);
    add_viscous_force(x, v, p, viscous);
  }
  /// Adds the derivative of the viscous force with respect to parameter k [N per unit].
  virtual void add_viscous_force_derivative(const Positions& /*x*/, const Vector& /*v*/,
                                            EffectParameters /*p*/, int /*k*/,
                                            Forces& /*df*/) const {}
  /// Adds the mass of each node [kg] that is not the tissue's.
  virtual void add_mass(EffectParameters /*p*/, Vector& /*mass*/) const {}

  /// Node pairs this effect couples beyond those that share an element.
  virtual std::vector<std::pair<int, int>> couplings() const { return {}; }
};

}  // namespace genio
