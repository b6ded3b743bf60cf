#include "inverse/solver/descent.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace genio {
namespace {

constexpr double longest_step = 8e-3;  // of any node of the targets [m]
constexpr double smallest_trust = 1e-7;
constexpr double on_bound = 1e-4;    // of an unknown
constexpr size_t patience = 4;       // iterations
constexpr double little = 1e-3;      // progress in them, of the objective and of its unit
constexpr double worth_trying = 30;  // times the tolerance
constexpr double hope = 2;           // times what a step promises

/// The minimum of the local problem within `trust` of its anchor, unknowns that their bounds press
/// on put there.
Vector minimum(LocalModel& local, const MisfitProblem& problem, double trust, int& iterations) {
  const Vector &lower = problem.lower(), &upper = problem.upper(), &anchor = local.anchor();
  local.set_bounds(lower.cwiseMax((anchor.array() - trust).matrix()),
                   upper.cwiseMin((anchor.array() + trust).matrix()));
  ProgramOptions options;
  options.barrier = 1e-4;
  options.barrier_tolerance = 100;
  options.tolerance = 1e-5;
  const ProgramResult r = solve(local, anchor, options);
  iterations += r.iterations;
  if (r.v.size() != anchor.size()) return anchor;  // all unknowns are fixed
  Vector u = r.v;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    if (u[i] - lower[i] < on_bound && r.lower_multipliers[i] > u[i] - lower[i]) u[i] = lower[i];
    if (upper[i] - u[i] < on_bound && r.upper_multipliers[i] > upper[i] - u[i]) u[i] = upper[i];
  }
  return u;
}

double at(LocalModel& local, const Vector& u) {
  double value = 0;
  local.value(u, value);
  return value;
}

}  // namespace

DescentResult descend(MisfitProblem& problem, const Vector& start, const DescentOptions& options) {
  DescentResult result;
  const auto failed = [&](std::string why) {
    result.message = std::move(why);
    return result;
  };
  auto value = problem.value(start);
  std::shared_ptr<LocalModel> local;
  if (value) local = problem.local(start);
  if (!local) return failed(fmt::format("no start: {}", problem.last_failure()));
  result.u = start, result.value = *value;
  double trust = 1;
  std::vector<double> values;
  for (;; ++result.iterations) {
    if (options.progress) options.progress(result.iterations, problem.rms());
    if (problem.stopped()) return result;
    if (result.iterations == options.max_iterations)
      return failed(fmt::format("not converged in {} steps", options.max_iterations));
    Vector u = minimum(*local, problem, trust, result.solver_iterations);
    double promise = result.value - at(*local, u);
    if (promise < options.tolerance) return result.converged = true, result;
    if (result.iterations > 0 && result.value - hope * promise > options.hopeless)
      return failed("far behind");
    // Where the tongue just touches bone the objective has kinks, and a smooth model promises what
    // is not there.
    values.push_back(result.value);
    if (values.size() > patience &&
        values[values.size() - 1 - patience] - result.value < little * (1 + result.value))
      return result.converged = true, result;
    Vector step = u - result.u;
    if (const double reach = local->reach(step); reach > longest_step) {
      step *= longest_step / reach;
      u = result.u + step;
      promise = result.value - at(*local, u);
    }

    value = problem.value(u);
    if (problem.stopped()) return result;
    const double gain = value ? result.value - *value : 0;
    std::shared_ptr<LocalModel> next;
    if (gain > 1e-3 * promise) next = problem.local(u);
    const double length = step.cwiseAbs().maxCoeff();
    if (!value || gain < 0.25 * promise) trust = value ? 0.5 * length : 0.25 * length;
    else if (gain > 0.7 * promise) trust = std::max(trust, 2.5 * length);
    if (next) {
      local = std::move(next);
      result.u = u, result.value = *value;
      // The next promise is about what this one was wrong by.
      if (std::abs(gain - promise) < options.tolerance ||
          (promise < options.roughness && gain < 0.5 * promise))
        return result.converged = true, result;
    } else if (promise < options.roughness) {
      return result.converged = true, result;
    } else if (trust < smallest_trust) {
      if (promise < worth_trying * options.tolerance) return result.converged = true, result;
      return failed(fmt::format("no step lowers the misfit{}{}",
                                problem.last_failure().empty() ? "" : ": ",
                                problem.last_failure()));
    }
  }
}

}  // namespace genio
