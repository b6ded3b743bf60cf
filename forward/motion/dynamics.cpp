#include "forward/motion/dynamics.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/algebra/quasi_newton.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/motion/motion_step.hpp"

namespace genio {
namespace {

constexpr int most_iterations = 20;     // on one factor
constexpr int most_order = 6;           // of the extrapolation from earlier steps
constexpr double shortest_step = 1e-7;  // [s]

class Simulation {
 public:
  Simulation(const Model& model, const CommandsOverTime& commands, Workspace& ws,
             const TimeOptions& options)
      : model_(model),
        commands_(commands),
        ws_(ws),
        options_(options),
        mass_(mass_matrix(model, commands.at(0))),
        scratch_(model.pattern) {}

  void run(const Positions& start, Trajectory& result);

 private:
  /// The state after `dt`; false when its iterations do not converge.
  bool advance(const MotionState& from, double dt, MotionState& to, Trajectory& result);
  Vector first_acceleration(const Positions& start);
  Vector predict(const MotionState& from, double dt) const;
  Instant instant(const MotionState& s) const;
  void record(const MotionState& before, const MotionState& after, Instant now,
              Trajectory& result) const;

  const Model& model_;
  const CommandsOverTime& commands_;
  Workspace& ws_;
  const TimeOptions& options_;
  NodeMatrix mass_;
  Stiffness scratch_;
  InverseUpdates updates_;
  double factor_step_ = 0;            // the step that the factor was made for; 0: none
  std::vector<MotionState> history_;  // of equal steps
};

/// Extrapolates the displacements of the last equal steps by the polynomial that would have met the
/// last of them best.
Vector Simulation::predict(const MotionState& from, double dt) const {
  const int n = int(history_.size());
  int equal = 0;  // steps of this length
  while (equal + 1 < n && std::abs(history_[size_t(n - 1 - equal)].time -
                                   history_[size_t(n - 2 - equal)].time - dt) < 1e-9)
    ++equal;
  // Through k + 1 points that end `back` steps ago: sum of (-1)^i C(k+1, i+1) u_(n-i).
  const auto extrapolated = [&](int k, int back) {
    Vector u = Vector::Zero(from.u.size());
    double c = k + 1;
    for (int i = 0; i <= k; ++i) {
      u += c * history_[size_t(n - 1 - back - i)].u;
      c *= -double(k - i) / (i + 2);
    }
    return u;
  };
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k < equal && k <= most_order; ++k) {
    const double error = (extrapolated(k, 1) - from.u).squaredNorm();
    if (error < least) best = k, least = error;
  }
  return best == 0 ? Vector(from.u + dt * from.v) : extrapolated(best, 0);
}

bool Simulation::advance(const MotionState& from, double dt, MotionState& to, Trajectory& result) {
  const TimeScheme& s = options_.scheme;
  const Parameters p = commands_.at(from.time + (1 - s.alpha_f) * dt);
  MotionStep step(model_, mass_, s, from, dt, p);
  Vector u = predict(from, dt);
  const double allowed = options_.tolerance * load_size(model_, step.shape(u), p);
  if (factor_step_ != dt) {
    if (!step.factorize(u, scratch_, ws_)) return false;
    factor_step_ = dt, updates_.forget();
  }
  bool fresh = false;
  Vector r = step.residual(u);
  double first = r.norm();
  // An iteration here, with its forces, is worth two of those that only solve.
  const double worth = 0.6 * ws_.cholesky.iterations_per_factor();
  for (int since = 0;; ++since) {
    ++result.newton_iterations;
    const double now = r.norm();
    if (now <= allowed) break;
    if (!std::isfinite(now) || since > most_iterations) return false;
    // A new factor where it is cheaper than the iterations that the old one still asks for.
    const double rate = std::pow(now / first, 1.0 / std::max(1, since));
    if (!fresh && since >= 2 && !(std::log(allowed / now) / std::log(rate) < worth && rate < 1)) {
      if (!step.factorize(u, scratch_, ws_)) return factor_step_ = 0, false;
      updates_.forget();
      fresh = true, since = 0, first = now;
    }
    // The factor leaves out the 1 - alpha_f that forces at an earlier instant have.
    const Vector d = updates_.apply(r, [&](const Vector& b) -> Vector {
      return ws_.cholesky.precondition(b) / (1 - s.alpha_f);
    });
    double t = 1;
    Vector next;
    for (int halvings = 0; halvings < 4; ++halvings, t *= 0.5) {
      next = step.residual(u + t * d);
      // Energy norm by the directions at hand: a step may raise the plain norm of stiff parts.
      if (std::abs(next.dot(d)) <= 0.9 * std::abs(r.dot(d))) break;
    }
    updates_.learn(t * d, r - next);
    u += t * d;
    r = next;
  }
  to = step.at(u);
  to.viscous = step.viscous();
  return true;
}

Instant Simulation::instant(const MotionState& s) const {
  const Positions x = model_.rest + model_.dofs.expand(s.u);
  const Vector v = model_.dofs.expand(s.v);
  return {s.time,
          x,
          v,
          model_.dofs.expand(s.a),
          0.5 * v.dot(multiply(mass_, v)),
          energy(model_, x, commands_.at(s.time)),
          0,
          0};
}

/// What viscous forces took, by their value in the middle of the step, and what changing parameters
/// did, by the trapezoidal rule.
void Simulation::record(const MotionState& before, const MotionState& after, Instant now,
                        Trajectory& result) const {
  const Instant& last = result.instants.back();
  const double back =
      0.5 - options_.scheme.alpha_f;  // from the instant of the forces to the middle
  const Vector viscous = (1 - back) * after.viscous + back * before.viscous;
  now.dissipated = last.dissipated - viscous.dot(after.u - before.u);
  const Parameters was = commands_.at(before.time), is = commands_.at(after.time);
  now.work_done = last.work_done;
  if (was != is)
    now.work_done += 0.5 * (energy(model_, last.x, is) - energy(model_, last.x, was) +
                            energy(model_, now.x, is) - energy(model_, now.x, was));
  result.max_penetration = std::max(result.max_penetration, max_penetration(model_, now.x, is));
  result.instants.push_back(std::move(now));
}

/// M a = F at rest.
Vector Simulation::first_acceleration(const Positions& start) {
  scratch_.set_zero();
  scratch_.add(mass_, 1);
  ReducedStiffness m(*model_.pattern, model_.dofs);
  m.assign(scratch_);
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>> solver(m.lower());
  solver.setTolerance(1e-12);
  return solver.solve(model_.dofs.reduce(force(model_, start, commands_.at(0))));
}

void Simulation::run(const Positions& start, Trajectory& result) {
  MotionState s;
  s.u = model_.dofs.pick(start - model_.rest);
  s.v = Vector::Zero(s.u.size());
  s.a = first_acceleration(start);
  s.viscous = Vector::Zero(s.u.size());
  history_ = {s};
  result.instants = {instant(s)};
  double dt = std::min(options_.step, options_.duration);
  while (s.time < options_.duration * (1 - 1e-9)) {
    const double wanted = std::min(dt, options_.duration - s.time);
    MotionState next;
    Instant now;
    bool good = advance(s, wanted, next, result);
    if (good) now = instant(next), good = std::isfinite(now.potential);  // right side out
    double error = 0;
    if (good && options_.accuracy > 0) {
      const double c = wanted * wanted * std::abs(options_.scheme.beta - 1.0 / 6);
      const Vector e = model_.dofs.expand(c * (next.a - s.a));
      error = e.reshaped(3, e.size() / 3).colwise().norm().maxCoeff();
      good = error <= options_.accuracy;
    }
    if (!good) {
      ++result.rejected;
      dt = 0.5 * wanted;
      if (dt >= shortest_step) continue;
      result.message = fmt::format("no motion found beyond {:.4f} s, not even in steps of {:.1e} s",
                                   s.time, shortest_step);
      return;
    }
    record(s, next, std::move(now), result);
    s = std::move(next);
    history_.push_back(s);
    if (history_.size() > most_order + 2) history_.erase(history_.begin());
    if (options_.progress) options_.progress(std::min(1.0, s.time / options_.duration));
    const bool grow = options_.accuracy > 0 ? error < options_.accuracy / 10 : true;
    if (grow && dt < options_.step) dt = std::min(2 * dt, options_.step);
  }
  result.status = SolveStatus::converged;
}

}  // namespace

TimeScheme TimeScheme::generalised_alpha(double r) {
  if (!(r >= 0 && r <= 1))
    throw InputError(fmt::format("spectral radius {}; expected a number from 0 to 1", r));
  TimeScheme s;
  s.alpha_m = (2 * r - 1) / (r + 1), s.alpha_f = r / (r + 1);
  s.gamma = 0.5 - s.alpha_m + s.alpha_f;
  s.beta = 0.25 * (1 - s.alpha_m + s.alpha_f) * (1 - s.alpha_m + s.alpha_f);
  return s;
}

Trajectory simulate(const Model& given, const CommandsOverTime& commands, const Positions& start,
                    Workspace& ws, const TimeOptions& options) {
  if (!(options.duration > 0) || !(options.step > 0))
    throw InputError("dynamics: duration and step must be above 0 s");
  ws.check(given);
  const auto here = at_anatomy(given, commands.at(0));
  const Model& model = *here;
  Trajectory result;
  const int before = ws.cholesky.factorizations();
  const CommandsOverTime pulls = activated(model, commands);
  Simulation(model, pulls, ws, options).run(carried(given, start, commands.at(0)), result);
  result.factorizations = ws.cholesky.factorizations() - before;
  return result;
}

double rise_time(const Trajectory& t, int node) {
  const Vec3 first = node_position(t.instants.front().x, node);
  const Vec3 way = node_position(t.instants.back().x, node) - first;
  if (!(way.norm() > 0)) return 0;
  const auto reached = [&](double part) {
    double before = 0, time = t.instants.front().time;
    for (const auto& i : t.instants) {
      const double now = (node_position(i.x, node) - first).dot(way) / way.squaredNorm();
      if (now >= part)
        return now > before ? time + (i.time - time) * (part - before) / (now - before) : i.time;
      before = now, time = i.time;
    }
    return time;
  };
  return reached(0.9) - reached(0.1);
}

}  // namespace genio
