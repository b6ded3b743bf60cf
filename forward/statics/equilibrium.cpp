#include "forward/statics/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/model/at_anatomy.hpp"
#include "forward/statics/newton.hpp"

namespace genio {
namespace {

constexpr int stage_tries = 5;           // each 0.4 times as long as the one before
constexpr double shortest_stage = 0.02;  // of the unbalanced force; below it springs do better
constexpr double longest_stage = 0.3;    // velocity gradient of its first step
constexpr double far_step = 2e-3;        // [m]
constexpr double near_balance = 0.05;    // residual over the applied forces
constexpr double rough = 0.1;            // that will do under a contact softer than it is

/// Newton iterations from result.x at result.parameters.
void iterate(const Model& model, Workspace& ws, const SolveOptions& options, Equilibrium& result) {
  Newton newton(model, result.parameters, ws, options.max_factorizations);
  Positions& x = result.x;
  result.status = SolveStatus::failed;
  MixedState state = newton.at(x), reached;
  if (!std::isfinite(state.energy)) {
    result.message = "the start shape has inverted tissue";
    return;
  }
  double t = 1, springs = 0;
  for (int i = 0; i <= options.max_iterations; ++i) {
    const double reference = newton.reference(x);
    result.residual = state.force.norm() / reference;
    result.energy = state.energy;
    if (result.residual <= std::max(options.tolerance, newton.rounding(x) / reference)) {
      result.status = SolveStatus::converged;
      result.message.clear();
      return;
    }
    if (newton.spent()) {
      result.message = fmt::format("not converged in {} factorisations (relative residual {:.1e})",
                                   options.max_factorizations, result.residual);
      return;
    }
    const double accuracy = std::clamp(0.3 * result.residual, 1e-3, 0.02);
    newton.set_springs(springs);
    newton.assemble(state);
    MixedVector d = newton.direction(state, accuracy);
    ++result.newton_iterations;
    bool advanced = false;
    if (springs == 0) {
      const Vector along = model.dofs.expand(d.u);
      t = std::min({t, step_limit(model, x, along, result.parameters),
                    longest_stage / ws.curved.size(x, along)});
      for (int tries = 0; tries < stage_tries && t > shortest_stage && newton.shift() == 0;
           ++tries, t *= 0.4) {
        advanced =
            newton.stage(state, d, t, t == 1 ? 1e-4 : 3e-2, reached, result.newton_iterations);
        if (advanced) break;
        if (!ws.cholesky.valid()) newton.assemble(state), d = newton.direction(state, accuracy);
      }
      if (advanced) t = std::min(1.0, 3 * t);
      else springs = std::max(1e-3, 2 * newton.shift()), t = 1;
    } else if (newton.shift() > 0) {
      springs = std::max(8 * springs, 2 * newton.shift());
    } else {
      const bool settled = newton.stage(state, d, 1, 1e-2, reached, result.newton_iterations);
      // A way down is welcome even where the stage has not settled.
      advanced = settled || newton.potential(reached.x) < result.energy;
      springs *= settled ? 0.25 : advanced ? 2 : 8;
      if (springs < 1e-5) springs = 0;
    }
    if (advanced) x = reached.x, state = newton.at(x, std::move(reached.pressure));
    else if (springs > 1e3) {
      if (result.residual < 100 * options.tolerance) {  // rounding is what is left
        result.status = SolveStatus::converged;
        return;
      }
      result.message = fmt::format("no step lowers the energy any more (relative residual {:.1e})",
                                   result.residual);
      return;
    }
  }
  result.message = fmt::format("not converged in {} Newton steps (relative residual {:.1e})",
                               options.max_iterations, result.residual);
}

/// Length of the longest nodal displacement of the Newton step from x [m]; 0 where little is
/// unbalanced.
double step_length(const Model& model, const Parameters& p, const Positions& x, Workspace& ws) {
  Newton newton(model, p, ws);
  const MixedState state = newton.at(x);
  if (state.force.norm() < near_balance * newton.reference(x)) return 0;
  newton.assemble(state);
  const Vector d = model.dofs.expand(newton.direction(state, 0.1).u);
  return d.reshaped(3, d.size() / 3).colwise().norm().maxCoeff();
}

/// iterate(), with contact soft at first when the start is far: where many nodes touch at once,
/// a stiff penalty lets them in and out by turns.
void solve_softly(const Model& model, Workspace& ws, const SolveOptions& options,
                  Equilibrium& result) {
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
      coarse.tolerance = rough;
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
    solve_softly(model, ws, options, result);
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

/// The model at the anatomy of p; null, and the reason in `result`, where there is none.
std::shared_ptr<const Model> checked_model(const Model& model, const Parameters& p,
                                           Equilibrium& result) {
  result.parameters = p;
  if (!p.allFinite()) {
    result.message = "a parameter is not finite";
    return nullptr;
  }
  try {
    return at_anatomy(model, p);
  } catch (const InputError& error) {
    result.message = error.what();
    return nullptr;
  }
}

}  // namespace

Workspace::Workspace(const Model& model)
    : stiffness(model.pattern),
      reduced(*model.pattern, model.dofs),
      cholesky(reduced),
      curved(model.mesh, model.supports) {}

void Workspace::check(const Model& model) const {
  if (!stiffness.is_on(model.pattern))
    throw std::invalid_argument(model.name + ": the workspace was made for another model");
}

bool Workspace::factorize(const Model& model, const Positions& x, const Parameters& p,
                          double shift) {
  reduced.assign(stiffness);
  if (!cholesky.factorize(reduced, shift)) return mixed.forget(), false;
  mixed.remember(bulk(model, x, p), reduced.lower().diagonal(), model.dofs);
  return true;
}

Equilibrium solve_equilibrium(const Model& model, const Parameters& p, const Positions& start,
                              Workspace& ws, const SolveOptions& options) {
  ws.check(model);
  Equilibrium result;
  const int before = ws.cholesky.factorizations();
  result.x = start;
  const auto here = checked_model(model, p, result);
  if (!here) return result;
  if (model.shapes) result.x = carried(model, start, p);
  solve_softly(*here, ws, options, result);
  if (!result && options.max_load_steps > 0) continuation(*here, p, ws, options, result);
  result.factorizations = ws.cholesky.factorizations() - before;
  return result;
}

Equilibrium solve_small_deformation(const Model& given, const Parameters& p, Workspace& ws) {
  ws.check(given);
  Equilibrium result;
  const auto here = checked_model(given, p, result);
  if (!here) return result;
  const Model& model = *here;
  result.x = model.rest;
  const int before = ws.cholesky.factorizations();
  Newton newton(model, p, ws);
  // The commands' geometric stiffness belongs to the large-deformation framework.
  Parameters unloaded = p;
  for (size_t k = 0; k < model.parameters.size(); ++k)
    if (model.parameters[k].info.load) unloaded[k] = model.parameters[k].info.absent;
  stiffness(model, model.rest, unloaded, ws.stiffness);
  if (!ws.factorize(model, model.rest, unloaded)) {
    result.message = "the stiffness of the rest shape is not positive definite";
    return result;
  }
  result.x += model.dofs.expand(ws.cholesky.solve(newton.at(model.rest).force));
  result.status = SolveStatus::converged;
  result.energy = newton.potential(result.x);
  result.newton_iterations = 1;
  result.factorizations = ws.cholesky.factorizations() - before;
  return result;
}

}  // namespace genio
