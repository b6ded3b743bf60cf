#pragma once
// The steps of one Newton solve; equilibrium.cpp decides which to take. Not for other files.

#include <optional>

#include "forward/statics/equilibrium.hpp"

namespace genio {

/// A shape with the pressures that steps so far predicted for it, and what is unbalanced there.
struct MixedState {
  Positions x;
  Vector pressure;  ///< of each element [Pa]
  Bulk bulk;
  Vector force;       ///< unbalanced, with the pressures that the volumes give [N]
  MixedVector right;  ///< unbalanced force [N]; pressure/c less the excess of volume [m^3]
  double merit = 0;   ///< squared energy norm of the step that the last factor would take
  double energy = 0;  ///< potential, of the springs and of the force that is held too [J]
};

/// Everything one Newton solve looks at, so that its steps read like the method.
class Newton {
 public:
  Newton(const Model& model, const Parameters& p, Workspace& ws, int factorizations = 1 << 30)
      : model_(model),
        p_(p),
        ws_(ws),
        last_factorization_(ws.cholesky.factorizations() + factorizations) {}

  bool spent() const { return ws_.cholesky.factorizations() > last_factorization_; }

  double potential(const Positions& x) const { return energy(model_, x, p_); }

  double reference(const Positions& x) const { return load_size(model_, x, p_); }

  /// What rounding of positions alone leaves of the residual [N]: stiff springs make it large. 0
  /// before the first tangent.
  double rounding(const Positions& x) const;

  /// At the shape x with the given pressures, or its own. The energy is infinite where tissue is
  /// inverted.
  MixedState at(const Positions& x, const std::optional<Vector>& pressure = {}) const;

  /// The tangent for a step from `state`, itself reached from `previous` by following `step`.
  void assemble(const MixedState& state, const Positions& previous, const Vector& step);
  void assemble(const MixedState& s) { assemble(s, s.x, Vector::Zero(s.x.size())); }

  /// Springs from every unknown to where the step began, as a part of K's mean diagonal; 0: none.
  void set_springs(double part) { spring_ = part; }
  /// The last shift that K with its springs needed to be positive definite, in the same unit; 0
  /// when it needed none.
  double shift() const { return shift_; }

  /// Solves K + springs for what is unbalanced; where that is indefinite a shift makes it descend.
  /// No step at all, and an infinite shift, where none does.
  MixedVector direction(const MixedState& state, double accuracy);

  /// Finds `reached` where the fraction `t` of the unbalanced force at `from` is gone, r(y) =
  /// (1 - t) r(x), or with springs where r(y) = (1 - t) r(x) + springs (y - x), starting with t
  /// times the direction `d`. Its own Newton iterations let the pressure of nearly incompressible
  /// tissue settle, which one straight step leaves far off. False when they do not contract, or
  /// leave the region where tissue is the right side out.
  bool stage(const MixedState& from, const MixedVector& d, double t, double accuracy,
             MixedState& reached, int& iterations);

 private:
  /// at(), with the force that is held and the springs to where the stage began.
  MixedState on_stage(const MixedState& from, const Positions& y, Vector pressure,
                      const Vector& held) const;
  double merit(const MixedVector& right) const;
  bool iterate(const MixedState& state, double accuracy, MixedVector& d);
  bool factorize() { return ws_.factorize(model_, x_, p_, (spring_ + shift_) * mean_); }

  const Model& model_;
  const Parameters& p_;
  Workspace& ws_;
  int last_factorization_;
  Positions x_;                                         // of the tangent
  double mean_ = 0;                                     // of the first tangent's diagonal [N/m]
  double spring_ = 0, shift_ = 0, first_shift_ = 1e-4;  // over mean_
};

}  // namespace genio
