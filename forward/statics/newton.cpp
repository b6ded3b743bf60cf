#include "forward/statics/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace genio {
namespace {

constexpr double largest_shift = 1e12;  // of K's mean diagonal: what needs more is no tissue
constexpr int stage_iterations = 10;    // Newton steps towards a part of the load

/// a / b, 0 where b is 0: an element without bulk has no pressure.
Vector quotient(const Vector& a, const Vector& b) {
  return (b.array() == 0).select(0, a.array() / b.array());
}

}  // namespace

double Newton::rounding(const Positions& x) const {
  if (mean_ == 0) return 0;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return epsilon * ws_.reduced.lower().diagonal().cwiseProduct(model_.dofs.pick(x)).norm();
}

MixedState Newton::at(const Positions& x, const std::optional<Vector>& pressure) const {
  MixedState s{x, {}, {}, {}, {}, std::numeric_limits<double>::infinity(), potential(x)};
  if (!std::isfinite(s.energy)) return s;
  s.bulk = bulk(model_, x, p_);
  const Vector own = s.bulk.pressure();
  s.pressure = pressure.value_or(own);
  Forces f = force(model_, x, p_);
  s.force = model_.dofs.reduce(f);
  s.bulk.gradients.add_times(own - s.pressure, f);
  s.right = {model_.dofs.reduce(f), quotient(s.pressure, s.bulk.stiffness) - s.bulk.excess};
  return s;
}

MixedState Newton::on_stage(const MixedState& from, const Positions& y, Vector pressure,
                            const Vector& held) const {
  MixedState s = at(y, std::move(pressure));
  if (!std::isfinite(s.energy)) return s;
  const Vector u = model_.dofs.pick(y - from.x);
  s.energy += held.dot(u) + 0.5 * spring_ * mean_ * u.squaredNorm();
  s.right.u -= held + spring_ * mean_ * u;
  s.merit = merit(s.right);
  return s;
}

double Newton::merit(const MixedVector& right) const {
  return ws_.mixed.norm(ws_.cholesky, right, model_.dofs);
}

void Newton::assemble(const MixedState& s, const Positions& previous, const Vector& step) {
  const Vector dilatation = quotient(s.pressure, s.bulk.stiffness.cwiseProduct(s.bulk.volume));
  step_stiffness(model_, s.x, {previous, step, dilatation}, p_, ws_.stiffness);
  x_ = s.x;
  if (mean_ > 0) return;
  ws_.reduced.assign(ws_.stiffness);
  mean_ = ws_.reduced.trace() / double(model_.dofs.unknowns());
}

bool Newton::iterate(const MixedState& s, double accuracy, MixedVector& d) {
  const auto product = [&](const Vector& v) -> Vector {
    return model_.dofs.reduce(ws_.stiffness.multiply(model_.dofs.expand(v))) + spring_ * mean_ * v;
  };
  const int patience = std::clamp(ws_.cholesky.iterations_per_factor(), 20, 40);
  if (ws_.mixed.iterations() > patience / 2) return false;  // worn out
  return ws_.mixed.solve(ws_.cholesky, model_.dofs, product, s.bulk, s.right, accuracy, patience,
                         d) &&
         d.u.dot(product(d.u)) > 0;  // or K is not positive definite
}

MixedVector Newton::direction(const MixedState& s, double accuracy) {
  shift_ = 0;
  MixedVector d;
  if (iterate(s, accuracy, d)) return d;
  if (!factorize()) {
    for (shift_ = first_shift_; !factorize(); shift_ *= 8)
      if (!(shift_ < largest_shift && mean_ > 0)) {
        shift_ = std::numeric_limits<double>::infinity();
        return {Vector::Zero(s.right.u.size()), Vector::Zero(s.right.pressure.size())};
      }
    first_shift_ = std::max(1e-4, shift_ / 8);
  }
  return ws_.mixed.step(ws_.cholesky, s.right, model_.dofs);
}

bool Newton::stage(const MixedState& from, const MixedVector& d, double t, double accuracy,
                   MixedState& reached, int& iterations) {
  const Vector held = (1 - t) * from.right.u;  // a dead load that keeps this much unbalanced
  const double start = merit(from.right);
  Positions before = from.x;
  Vector along = t * model_.dofs.expand(d.u);
  MixedState& at = reached;
  at = on_stage(from, ws_.curved(from.x, along), from.pressure + t * d.pressure, held);
  for (int i = 0; i < stage_iterations; ++i) {
    if (!std::isfinite(at.energy)) return false;
    if (at.merit <= accuracy * start) return true;
    if (spent()) return false;
    assemble(at, before, along);
    ++iterations;
    const MixedVector c = direction(at, 0.03);
    if (!ws_.cholesky.valid()) return false;
    at.merit = merit(at.right);  // the factor may be a new one
    along = model_.dofs.expand(c.u);
    double part = step_limit(model_, at.x, along, p_);
    along *= part;
    MixedState next;
    for (int halvings = 0;; ++halvings, along *= 0.3, part *= 0.3) {
      next = on_stage(from, ws_.curved(at.x, along), at.pressure + part * c.pressure, held);
      // Merit settles the volume, energy everything else: either may lead.
      if (next.merit < at.merit || next.energy < at.energy) break;
      if (halvings == 4) return false;
    }
    before = at.x;
    at = std::move(next);
  }
  return at.merit <= accuracy * start;
}

}  // namespace genio
