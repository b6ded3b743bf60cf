#pragma once
// Linear systems of nearly incompressible tissue on a factor of another shape's stiffness.

#include <functional>

#include "forward/algebra/cholesky.hpp"
#include "forward/algebra/supports.hpp"
#include "forward/geometry/volume_gradients.hpp"

namespace genio {

/// What a step of displacements and pressures is to take away, or such a step itself.
struct MixedVector {
  Vector u;         ///< over the unknowns: unbalanced force [N], or displacement [m]
  Vector pressure;  ///< of each element: volume error [m^3], or change of pressure [Pa]
};

/// A factor of one K0 preconditions another K = A + G diag(c) G^T badly where tissue is nearly
/// incompressible: c amplifies every change of G. With pressures as unknowns of their own,
///
///     [ A    G    ] [d]   [r]
///     [ G^T -1/c  ] [q] = [s],
///
/// nothing amplifies, and the factor of K0 solves this system exactly as it was at K0's shape:
/// d = K0^-1 (r + G0 c0 s), q = c0 (G0^T d - s) (a constraint preconditioner, Benzi, Golub & Liesen
/// 2005, Acta Numerica 14, section 10). GMRES with it (Saad & Schultz 1986) takes as many
/// iterations as the change of shape deserves.
class MixedSolver {
 public:
  /// The factor's shape has this bulk. `diagonal`: of K0 over the unknowns.
  void remember(Bulk bulk, const Vector& diagonal, const DofMap& dofs);
  void forget() { stale_ = {}, last_ = {}; }

  /// The step that the factor itself takes: exact for the shape that it belongs to.
  MixedVector step(const Cholesky& factor, const MixedVector& right, const DofMap& dofs) const;
  /// Energy norm of the factor's step, squared, in single precision [J].
  double norm(const Cholesky& factor, const MixedVector& right, const DofMap& dofs);

  using Product = std::function<Vector(const Vector&)>;
  /// Solves the system of K, given by its products, and `now`, to `accuracy` of the step's energy
  /// norm; single precision stands in the way of more than about 1e-5. False where that takes more
  /// than `patience` iterations.
  bool solve(const Cholesky& factor, const DofMap& dofs, const Product& k, const Bulk& now,
             const MixedVector& right, double accuracy, int patience, MixedVector& step);
  /// Of the last solve() on this factor; 0 when there was none.
  int iterations() const { return iterations_; }

 private:
  /// A force over the unknowns, and the factor's displacement by it in single precision.
  struct Answered {
    Vector force, displacement;
  };

  /// r + G0 c0 s: the force that K0^-1 turns into the displacement of an approximate step.
  Vector condensed(const MixedVector& right, const DofMap& dofs) const;
  MixedVector with_pressure(Vector displacement, const MixedVector& right,
                            const DofMap& dofs) const;
  /// Of `force`; remembered, for a step is solved for where its norm was asked before.
  const Vector& displacement(const Cholesky& factor, Vector force);

  Bulk stale_;
  Answered last_;
  int iterations_ = 0;
  double stiffness_ = 1;  // of the tissue but for its bulk, typical of an unknown [N/m]
};

}  // namespace genio
