#include "forward/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr int stage_iterations = 10;   // Newton steps towards a part of the load
constexpr int stage_tries = 5;         // each 0.4 times as long as the one before
constexpr int patient_iterations = 14;  // conjugate gradients worth less than a factorisation
constexpr double far_step = 2e-3;      // [m]
constexpr double force_floor = 1e-3;  // [N]

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

  /// Size of the loads the residual is compared with [N].
  double reference(const Positions& x) const {
    double sum = 0;
    for (size_t e = 0; e < model_.effects.size(); ++e) {
      if (model_.effects[e]->name() == "elasticity") continue;
      Forces f = Forces::Zero(x.size());
      model_.effects[e]->add_force(x, effect_parameters(model_, p_, int(e)), f);
      sum += f.squaredNorm();
    }
    return std::max(std::sqrt(sum), force_floor);
  }

  /// The tangent for a step from x, itself reached by a step from `previous`.
  void assemble(const Positions& x, const Positions& previous) {
    step_stiffness(model_, x, previous, p_, ws_.stiffness);
    ws_.reduced.assign(ws_.stiffness);
  }

  /// Direction K^-1 r; away from equilibrium K may be indefinite, then a shift makes it descend.
  Vector direction(const Vector& r, double accuracy) {
    Vector d;
    if (ws_.cholesky.valid() && conjugate_gradients(r, accuracy, d)) return d;
    if (!ws_.cholesky.factorize(ws_.reduced)) {
      const double mean = ws_.reduced.trace() / double(r.size());
      shift_ = std::max(1e-4, shift_ / 8);
      while (!ws_.cholesky.factorize(ws_.reduced, shift_ * mean)) shift_ *= 8;
    }
    return ws_.cholesky.solve(r);
  }

  struct State {
    Vector r;       // unbalanced force
    double merit;   // its squared energy norm, by the last factor
    double energy;  // potential with the dead load `held`
  };
  State state(const Positions& y, const Positions& x, const Vector& held) const {
    State s{{}, std::numeric_limits<double>::infinity(), potential(y)};
    if (!std::isfinite(s.energy)) return s;
    s.energy += force_on(held, y - x);
    s.r = residual(y) - held;
    s.merit = s.r.dot(ws_.cholesky.solve(s.r));
    return s;
  }
  /// Work of the reduced force on a nodal displacement that respects the supports.
  double force_on(const Vector& reduced, const Vector& nodal) const {
    double work = 0;
    std::vector<bool> done(size_t(reduced.size()), false);
    for (Eigen::Index i = 0; i < nodal.size(); ++i)
      if (const int u = model_.dofs.unknown(int(i)); u >= 0 && !done[u])
        work += reduced[u] * nodal[i], done[u] = true;
    return work;
  }

  /// Takes away the fraction `t` of the unbalanced force: finds y with r(y) = (1 - t) r(x),
  /// starting with the step t d. Its own Newton iterations let the pressure of nearly
  /// incompressible tissue settle, which one straight step leaves far off. False when they do not
  /// contract, or leave the region where tissue is the right side out.
  bool stage(const Positions& x, const Vector& r, const Vector& d, double t, double accuracy,
             Positions& y, int& iterations) {
    const Vector held = (1 - t) * r;  // a dead load that keeps this much of the force unbalanced
    const double start = r.dot(d);
    y = x + model_.dofs.expand(t * d);
    Positions y_before = x;
    State at = state(y, x, held);
    for (int i = 0; i < stage_iterations; ++i) {
      if (!std::isfinite(at.energy)) return false;
      if (at.merit <= accuracy * start) return true;
      if (spent()) return false;
      assemble(y, y_before);
      ++iterations;
      const Vector c = direction(at.r, 0.03);
      at.merit = at.r.dot(ws_.cholesky.solve(at.r));  // the factor may be a new one
      Vector along = model_.dofs.expand(c);
      along *= step_limit(model_, y, along);
      State next;
      for (int halvings = 0;; ++halvings, along *= 0.3) {
        next = state(y + along, x, held);
        // Merit settles the volume, energy everything else: either may lead.
        if (next.merit < at.merit || next.energy < at.energy) break;
        if (halvings == 4) return false;
      }
      y_before = y;
      y += along;
      at = next;
    }
    return at.merit <= accuracy * start;
  }

  /// Shortens the step until the potential falls.
  bool line_search(Positions& x, const Vector& r, const Vector& d) const {
    const double e = potential(x), slope = r.dot(d);
    const Vector along = model_.dofs.expand(d);
    for (double t = 1; t > 1e-9; t *= 0.5) {
      const Positions y = x + t * along;
      if (potential(y) > e - 1e-4 * t * slope) continue;
      x = y;
      return true;
    }
    return false;
  }

 private:
  /// Preconditioned by the last factor. False when it is slow or meets negative curvature.
  bool conjugate_gradients(const Vector& b, double accuracy, Vector& x) const {
    x = Vector::Zero(b.size());
    Vector r = b, z = ws_.cholesky.solve(r), p = z;
    double rz = r.dot(z);
    const double target = accuracy * accuracy * rz;
    for (int i = 0; i < patient_iterations; ++i) {
      const Vector kp = ws_.reduced.multiply(p);
      const double curvature = p.dot(kp);
      if (!(curvature > 0)) return false;
      const double step = rz / curvature;
      x += step * p;
      r -= step * kp;
      z = ws_.cholesky.solve(r);
      const double next = r.dot(z);
      if (next <= target) return true;
      p = z + (next / rz) * p;
      rz = next;
    }
    return false;
  }

  const Model& model_;
  const Parameters& p_;
  Workspace& ws_;
  int last_factorization_;
  double shift_ = 0;  // last one needed, over the mean diagonal
};

/// Newton iterations from result.x at result.parameters.
void iterate(const Model& model, Workspace& ws, const SolveOptions& options,
             Equilibrium& result) {
  Newton newton(model, result.parameters, ws, options.max_factorizations);
  Positions& x = result.x;
  result.status = SolveStatus::failed;
  if (!std::isfinite(newton.potential(x))) {
    result.message = "the start shape has inverted tissue";
    return;
  }
  double t = 1;
  for (int i = 0; i <= options.max_iterations; ++i) {
    const Vector r = newton.residual(x);
    result.residual = r.norm() / newton.reference(x);
    result.energy = newton.potential(x);
    if (result.residual <= options.tolerance) {
      result.status = SolveStatus::converged;
      result.message.clear();
      return;
    }
    if (newton.spent()) {
      result.message = fmt::format("not converged in {} factorisations (relative residual {:.1e})",
                                   options.max_factorizations, result.residual);
      return;
    }
    const double accuracy = std::clamp(0.3 * result.residual, 1e-5, 0.05);
    newton.assemble(x, x);
    Vector d = newton.direction(r, accuracy);
    ++result.newton_iterations;
    t = std::min(t, step_limit(model, x, model.dofs.expand(d)));
    Positions y;
    bool advanced = false;
    for (int tries = 0; tries < stage_tries; ++tries, t *= 0.4) {
      advanced = newton.stage(x, r, d, t, t == 1 ? 1e-6 : 1e-3, y, result.newton_iterations);
      if (advanced) break;
      if (!ws.cholesky.valid()) newton.assemble(x, x), d = newton.direction(r, accuracy);
    }
    if (advanced) {
      x = y;
      t = std::min(1.0, 3 * t);
    } else {
      t = 0.3;
      if (!newton.line_search(x, r, d)) {
        if (result.residual < 100 * options.tolerance) {  // rounding is what is left
          result.status = SolveStatus::converged;
          return;
        }
        result.message = fmt::format(
            "no step lowers the energy any more (relative residual {:.1e})", result.residual);
        return;
      }
    }
  }
  result.message = fmt::format("not converged in {} Newton steps (relative residual {:.1e})",
                               options.max_iterations, result.residual);
}

/// Length of the longest nodal displacement of the Newton step from x [m].
double step_length(const Model& model, const Parameters& p, const Positions& x, Workspace& ws) {
  Newton newton(model, p, ws);
  newton.assemble(x, x);
  const Vector d = model.dofs.expand(newton.direction(newton.residual(x), 0.1));
  return d.reshaped(3, d.size() / 3).colwise().norm().maxCoeff();
}

/// iterate(), with contact soft at first when the start is far: where many nodes touch at once,
/// a stiff penalty lets them in and out by turns.
void settle(const Model& model, Workspace& ws, const SolveOptions& options, Equilibrium& result) {
  const Parameters full = result.parameters;
  const auto& slots = model.parameters;
  const bool touches = std::any_of(slots.begin(), slots.end(), [&](const ParameterSlot& s) {
    return s.info.penalty && full[&s - slots.data()] > 0;
  });
  if (touches && std::isfinite(energy(model, result.x, full)) &&
      step_length(model, full, result.x, ws) > far_step)
    for (const double softness : {1e-2, 1e-1}) {
      for (size_t k = 0; k < slots.size(); ++k)
        if (slots[k].info.penalty) result.parameters[k] = softness * full[k];
      SolveOptions coarse = options;
      coarse.tolerance = 1e-5;
      iterate(model, ws, coarse, result);
      if (!result) break;
    }
  result.parameters = full;
  iterate(model, ws, options, result);
}

/// Brings the loads up from zero, halving the step where it fails and doubling where it works.
void continuation(const Model& model, const Parameters& p, Workspace& ws,
                  const SolveOptions& options, Equilibrium& result) {
  Positions x = model.rest;
  double reached = 0, step = 0.5;
  while (result.load_steps++ < options.max_load_steps) {
    const double fraction = std::min(1.0, reached + step);
    result.parameters = p;
    for (size_t k = 0; k < model.parameters.size(); ++k)
      if (const auto& info = model.parameters[k].info; info.load)
        result.parameters[k] = info.absent + fraction * (p[k] - info.absent);
    result.x = x;
    settle(model, ws, options, result);
    if (result && fraction == 1.0) return;
    if (result) {
      x = result.x, reached = fraction, step *= 2;
    } else {
      step *= 0.5;
      if (step < 1.0 / 64) break;
    }
  }
  result.status = SolveStatus::failed;
  result.message = fmt::format("equilibrium found only up to {:.0f} % of the loads: {}",
                               100 * reached, result.message);
  result.parameters = p;
}

}  // namespace

Workspace::Workspace(const Model& model)
    : stiffness(model.pattern), reduced(model.pattern, model.dofs), cholesky(reduced) {}

Equilibrium solve_equilibrium(const Model& model, const Parameters& p, const Positions& start,
                              Workspace& ws, const SolveOptions& options) {
  Equilibrium result;
  const int before = ws.cholesky.factorizations();
  result.parameters = p;
  result.x = start;
  if (!p.allFinite()) {
    result.message = "a parameter is not finite";
    return result;
  }
  settle(model, ws, options, result);
  if (!result && options.max_load_steps > 0) continuation(model, p, ws, options, result);
  result.factorizations = ws.cholesky.factorizations() - before;
  return result;
}

Equilibrium solve_small_deformation(const Model& model, const Parameters& p, Workspace& ws) {
  Equilibrium result;
  result.parameters = p;
  const int before = ws.cholesky.factorizations();
  Newton newton(model, p, ws);
  // The commands' geometric stiffness belongs to the large-deformation framework.
  Parameters unloaded = p;
  for (size_t k = 0; k < model.parameters.size(); ++k)
    if (model.parameters[k].info.load) unloaded[k] = model.parameters[k].info.absent;
  Newton(model, unloaded, ws).assemble(model.rest, model.rest);
  if (!ws.cholesky.factorize(ws.reduced)) {
    result.message = "the stiffness of the rest shape is not positive definite";
    return result;
  }
  result.x = model.rest + model.dofs.expand(ws.cholesky.solve(newton.residual(model.rest)));
  result.status = SolveStatus::converged;
  result.energy = newton.potential(result.x);
  result.newton_iterations = 1;
  result.factorizations = ws.cholesky.factorizations() - before;
  return result;
}

}  // namespace genio
