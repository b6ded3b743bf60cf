#pragma once
// The steps of one Newton solve; equilibrium.cpp decides which to take. Not for other files.

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/equilibrium.hpp"

namespace genio {

inline constexpr int stage_iterations = 10;  // Newton steps towards a part of the load

/// Everything one Newton solve looks at, so that its steps read like the method.
class Newton {
 public:
  Newton(const Model& model, const Parameters& p, Workspace& ws, int factorizations = 1 << 30)
      : model_(model),
        p_(p),
        ws_(ws),
        last_factorization_(ws.cholesky.factorizations() + factorizations) {}

  bool spent() const { return ws_.cholesky.factorizations() > last_factorization_; }

  Vector residual(const Positions& x) const { return model_.dofs.reduce(force(model_, x, p_)); }
  double potential(const Positions& x) const { return energy(model_, x, p_); }

  double reference(const Positions& x) const { return load_size(model_, x, p_); }

  /// What rounding of positions alone leaves of the residual [N]: stiff springs make it large. 0
  /// before the first tangent.
  double rounding(const Positions& x) const {
    if (mean_ == 0) return 0;
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    return epsilon * ws_.reduced.lower().diagonal().cwiseProduct(model_.dofs.pick(x)).norm();
  }

  /// The tangent for a step from x, itself reached from `previous` by following the linear `step`.
  void assemble(const Positions& x, const Positions& previous, const Vector& step) {
    step_stiffness(model_, x, previous, step, p_, ws_.stiffness);
    ws_.reduced.assign(ws_.stiffness);
    if (mean_ == 0) mean_ = ws_.reduced.trace() / double(model_.dofs.unknowns());
  }
  void assemble(const Positions& x) { assemble(x, x, Vector::Zero(x.size())); }

  /// Springs from every unknown to where the step began, as a part of K's mean diagonal; 0: none.
  void set_springs(double part) { spring_ = part; }
  /// The last shift that K with its springs needed to be positive definite, in the same unit; 0
  /// when it needed none.
  double shift() const { return shift_; }

  /// Direction (K + springs)^-1 r; where that is indefinite a shift makes it descend.
  Vector direction(const Vector& r, double accuracy) {
    shift_ = 0;
    Vector d;
    if (ws_.cholesky.valid() && conjugate_gradients(r, accuracy, d)) return d;
    if (!ws_.cholesky.factorize(ws_.reduced, spring_ * mean_)) {
      shift_ = first_shift_;
      while (!ws_.cholesky.factorize(ws_.reduced, (spring_ + shift_) * mean_)) shift_ *= 8;
      first_shift_ = std::max(1e-4, shift_ / 8);
    }
    return ws_.cholesky.solve(r);
  }

  /// Finds y where the fraction `t` of the unbalanced force at x is gone, r(y) = (1 - t) r(x), or
  /// with springs where r(y) = (1 - t) r(x) + springs (y - x), starting with the step t d. Its own
  /// Newton iterations let the pressure of nearly incompressible tissue settle, which one straight
  /// step leaves far off. False when they do not contract, or leave the region where tissue is the
  /// right side out.
  bool stage(const Positions& x, const Vector& r, const Vector& d, double t, double accuracy,
             Positions& y, int& iterations) {
    const Vector held = (1 - t) * r;  // a dead load that keeps this much of the force unbalanced
    const double start = r.dot(d);
    Positions y_before = x;
    Vector along = t * model_.dofs.expand(d);
    y = ws_.curved(x, along);
    State at = state(x, y, held);
    for (int i = 0; i < stage_iterations; ++i) {
      if (!std::isfinite(at.energy)) return false;
      if (at.merit <= accuracy * start) return true;
      if (spent()) return false;
      assemble(y, y_before, along);
      ++iterations;
      const Vector c = direction(at.r, 0.03);
      at.merit = at.r.dot(ws_.cholesky.precondition(at.r));  // the factor may be a new one
      along = model_.dofs.expand(c);
      along *= step_limit(model_, y, along, p_);
      State next;
      Positions z;
      for (int halvings = 0;; ++halvings, along *= 0.3) {
        z = ws_.curved(y, along);
        next = state(x, z, held);
        // Merit settles the volume, energy everything else: either may lead.
        if (next.merit < at.merit || next.energy < at.energy) break;
        if (halvings == 4) return false;
      }
      y_before = y;
      y = z;
      at = next;
    }
    return at.merit <= accuracy * start;
  }

 private:
  struct State {
    Vector r;       // unbalanced force, less what is held and what the springs take
    double merit;   // its squared energy norm, by the last factor
    double energy;  // potential with the held load and the springs
  };
  State state(const Positions& x, const Positions& y, const Vector& held) const {
    State s{{}, std::numeric_limits<double>::infinity(), potential(y)};
    if (!std::isfinite(s.energy)) return s;
    const Vector u = model_.dofs.pick(y - x);
    s.energy += held.dot(u) + 0.5 * spring_ * mean_ * u.squaredNorm();
    s.r = residual(y) - held - spring_ * mean_ * u;
    s.merit = s.r.dot(ws_.cholesky.precondition(s.r));
    return s;
  }

  /// Preconditioned by the last factor. False when it is slow or meets negative curvature.
  bool conjugate_gradients(const Vector& b, double accuracy, Vector& x) const {
    x = Vector::Zero(b.size());
    Vector r = b, z = ws_.cholesky.precondition(r), p = z;
    double rz = r.dot(z);
    const double whole = rz, target = accuracy * accuracy * rz;
    const int patience = std::clamp(ws_.cholesky.iterations_per_factor(), 20, 30);
    for (int i = 0; i < patience; ++i) {
      const Vector kp =
          model_.dofs.reduce(ws_.stiffness.multiply(model_.dofs.expand(p))) + spring_ * mean_ * p;
      const double curvature = p.dot(kp);
      if (!(curvature > 0)) return false;
      const double step = rz / curvature;
      x += step * p;
      r -= step * kp;
      z = ws_.cholesky.precondition(r);
      const double next = r.dot(z);
      if (next <= target) return true;
      // At the rate so far it will not do: give up before the rest is spent.
      const double done = std::log(next / whole) / std::log(target / whole);
      if (i == 4 && done * patience < 0.6 * (i + 1)) return false;
      p = z + (next / rz) * p;
      rz = next;
    }
    return false;
  }

  const Model& model_;
  const Parameters& p_;
  Workspace& ws_;
  int last_factorization_;
  double mean_ = 0;                                     // of the first tangent's diagonal [N/m]
  double spring_ = 0, shift_ = 0, first_shift_ = 1e-4;  // over mean_
};

}  // namespace genio
