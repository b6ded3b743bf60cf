#include "discrepancy/conditions/joint_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "discrepancy/conditions/joint_problem.hpp"
#include "forward/base/median.hpp"
#include "inverse/posterior/box_gaussian.hpp"
#include "inverse/posterior/box_integral.hpp"
#include "inverse/posterior/posterior.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio {
namespace {

constexpr int most_steps = 25;
constexpr double roughness = 1;  // of the log posterior
// Of conditions inverted by themselves:
constexpr int more_starts = 3;
constexpr double much_worse = 1.4;  // than the median misfit
constexpr double guess_tolerance = 0.5;

std::vector<Eigen::Index> open_unknowns(const Vector& lower, const Vector& upper) {
  std::vector<Eigen::Index> open;
  for (Eigen::Index i = 0; i < lower.size(); ++i)
    if (lower[i] < upper[i]) open.push_back(i);
  return open;
}

/// What is expected of the unknowns before the shape is seen: their prior's mode.
Vector expected(const PriorTerms& prior) {
  Vector z = prior.lower;
  const auto open = prior.open();
  if (!open.empty()) z(open) = density_of(prior).mode;
  return z;
}

/// An inversion of one condition by itself.
Answer alone(ConditionSet& set, size_t k, int starts) {
  InferOptions options;
  options.bilateral = set.bilateral(k);
  options.tolerance = guess_tolerance;
  return infer_from_starts(set.model(k), set.condition(k).target, set.prior(k),
                           set.infer_workspace(k), options, {starts});
}

/// Inversions of the conditions of which no forces are known; empty answers for the others. One
/// that fits much worse than the rest may sit in a wrong valley and gets more starts.
std::vector<Answer> each_alone(ConditionSet& set) {
  std::vector<Answer> result(set.size());
  std::vector<double> rms;
  for (size_t k = 0; k < set.size(); ++k) {
    if (set.condition(k).forces) continue;
    result[k] = alone(set, k, 1);
    if (result[k].activations.size() > 0) rms.push_back(result[k].rms);
  }
  if (rms.empty()) return result;
  const double usual = median(std::move(rms));
  for (size_t k = 0; k < set.size(); ++k)
    if (!set.condition(k).forces &&
        (result[k].activations.size() == 0 || result[k].rms > much_worse * usual))
      result[k] = alone(set, k, more_starts);
  return result;
}

/// The unknowns of a part as an inversion by itself has them.
Vector guessed(ConditionSet& set, size_t k, const Answer& answer, JointProblem::Part& part,
               Vector z) {
  if (answer.activations.size() == 0) return z;
  const auto own = unknowns_of(set.model(k), set.prior(k), set.bilateral(k));
  const auto& unknowns = part.objective.unknowns();
  for (size_t i = 0; i < unknowns.size(); ++i)
    for (size_t j = 0; j < own.size(); ++j)
      if (own[j].name == unknowns[i].name) z[Eigen::Index(i)] = answer.activations[Eigen::Index(j)];
  part.options.start_shape = answer.shape;
  return z;
}

Vector start_of(const FittedCondition& before, const std::vector<Unknown>& unknowns,
                const std::map<ParameterName, double>& shared, Vector z) {
  for (size_t i = 0; i < unknowns.size(); ++i) {
    const Unknown& c = unknowns[i];
    for (size_t j = 0; j < before.unknowns.size(); ++j)
      if (before.unknowns[j].name == c.name)
        z[Eigen::Index(i)] = c.z_of(before.unknowns[j].value(before.z[Eigen::Index(j)]));
    if (const auto s = shared.find(c.parameter); s != shared.end())
      z[Eigen::Index(i)] = c.z_of(s->second);
  }
  return z;
}

/// Of each unknown's share of the prior between its bounds, for unknowns that the prior takes one
/// by one; and of all together.
struct PriorMass {
  double log_all = 0;
  Vector each;
};

PriorMass prior_mass(const JointFit& f, const std::vector<Eigen::Index>& open) {
  const Matrix a = f.prior_rows(Eigen::all, open);
  const Matrix h = a.transpose() * a;
  Vector fixed = f.u;
  for (auto i : open) fixed[i] = 0;
  const Vector centre = h.llt().solve(a.transpose() * (f.prior_values - f.prior_rows * fixed));
  const BoxGaussian prior = about(centre, h, f.lower(open), f.upper(open));
  PriorMass mass{log_integral(prior), Vector::Zero(Eigen::Index(open.size()))};
  for (Eigen::Index i = 0; i < mass.each.size(); ++i)
    mass.each[i] = std::exp(
        log_integral({prior.mode.segment(i, 1), prior.slope.segment(i, 1), h.block(i, i, 1, 1),
                      prior.lower.segment(i, 1), prior.upper.segment(i, 1)}));
  return mass;
}

/// Point masses of the prior at rest: a muscle that nothing is known of rests as often as it pulls.
/// Without them, whatever makes resting muscles seem to pull a little would be believed in.
Vector spikes_at_rest(const ConditionSet& set, const JointFit& f,
                      const std::vector<Eigen::Index>& open, const PriorMass& mass) {
  std::vector<bool> may_rest(size_t(f.u.size()), false);
  for (size_t k = 0; k < f.conditions.size(); ++k) {
    if (set.condition(k).forces) continue;
    const FittedCondition& c = f.conditions[k];
    for (size_t i = 0; i < c.unknowns.size(); ++i)
      if (c.unknowns[i].kind == Unknown::Kind::muscle) may_rest[size_t(c.which[i])] = true;
  }
  Vector spikes = Vector::Zero(Eigen::Index(open.size()));
  for (size_t i = 0; i < open.size(); ++i)
    if (may_rest[size_t(open[i])]) spikes[Eigen::Index(i)] = mass.each[Eigen::Index(i)];
  return spikes;
}

/// What is known of the shared unknowns after the fit. `all`: of the unknowns `open`.
std::vector<SharedEstimate> shared_estimates(const JointFit& f, const Model& model,
                                             const BoxIntegral& all,
                                             const std::vector<Eigen::Index>& open) {
  std::vector<SharedEstimate> result;
  const FittedCondition& c = f.conditions.front();
  for (size_t i = 0; i < c.unknowns.size(); ++i) {
    if (c.which[i] < f.own) continue;
    const Unknown& unknown = c.unknowns[i];
    SharedEstimate e{.name = unknown.parameter,
                     .unit = unknown.unit,
                     .value = unknown.value(c.z[Eigen::Index(i)]),
                     .kind = unknown.kind,
                     .axis = unknown.axis};
    e.low = e.high = e.value;
    if (const auto at = std::find(open.begin(), open.end(), c.which[i]); at != open.end()) {
      const Eigen::Index k = at - open.begin();
      const CutNormal cut =
          cut_normal(all.centre[k], all.sd[k], f.lower[c.which[i]], f.upper[c.which[i]]);
      e.value = unknown.value(cut.mode), e.sd = unknown.slope(e.value) * cut.sd;
      e.low = unknown.value(cut.low), e.high = unknown.value(cut.high);
    }
    // Through its unit and back a value may leave a bound by a rounding error.
    for (int k : unknown.parameters)
      for (double* v : {&e.value, &e.low, &e.high})
        *v = std::clamp(*v, model.parameters[size_t(k)].info.lower,
                        model.parameters[size_t(k)].info.upper);
    result.push_back(e);
  }
  return result;
}

/// Where the descent starts: at what is expected of the unknowns, but for those that the last fit
/// or an inversion of a condition by itself knows better.
Vector start_of(ConditionSet& set, JointProblem& problem, const FitOptions& options) {
  Vector u = Vector::Zero(problem.lower().size());
  const auto answers = options.start ? std::vector<Answer>() : each_alone(set);
  for (size_t k = 0; k < problem.size(); ++k) {
    auto& part = problem.part(k);
    const Vector z = expected(part.objective.prior());
    u(part.which) = options.start ? start_of((*options.start)[k], part.objective.unknowns(),
                                             options.shared_start, z)
                                  : guessed(set, k, answers[k], part, z);
  }
  return u.cwiseMax(problem.lower()).cwiseMin(problem.upper());
}

/// The fit with its conditions at the point it has reached. It ends, not converged, before the
/// first one that has no derivatives there.
JointFit with_conditions(JointFit f, const ConditionSet& set, JointProblem& problem) {
  for (size_t k = 0; k < problem.size(); ++k) {
    auto& part = problem.part(k);
    const Vector z = problem.of_part(f.u, k);
    const auto* p = part.objective.derivatives(z);
    if (!p) {
      f.converged = false;
      f.message = fmt::format("{}: {}", set.condition(k).name, part.objective.last_failure());
      return f;
    }
    f.conditions.push_back({part.objective.unknowns(), part.which, z, p->equilibrium.x,
                            p->equilibrium.parameters, p->residuals, p->jacobian});
    f.conditions.back().residuals.values = part.residuals(*p);
  }
  return f;
}

/// The fit with its log evidence and the estimates of what the conditions share.
JointFit with_evidence(JointFit f, const ConditionSet& set, const SharedPrior& shared,
                       const JointProblem& problem) {
  const auto open = open_unknowns(f.lower, f.upper);
  if (open.empty()) {
    f.log_evidence = shared.log_weight - f.value;
    return f;
  }
  const Matrix j = problem.whitened(f.jacobian())(Eigen::all, open);
  const Matrix a = f.prior_rows(Eigen::all, open);
  const Matrix h = j.transpose() * j + a.transpose() * a;
  const Vector slope = j.transpose() * problem.whitened(f.residuals()).col(0) +
                       a.transpose() * (f.prior_rows * f.u - f.prior_values);
  BoxGaussian density{f.u(open), slope, h, f.lower(open), f.upper(open)};
  for (Eigen::Index i = 0; i < slope.size(); ++i)
    if (pressed(density, i) == 0) density.slope[i] = 0;
  const PriorMass mass = prior_mass(f, open);
  const Vector spikes = spikes_at_rest(set, f, open, mass);
  const BoxIntegral all = integral(density, spikes);
  f.log_evidence = shared.log_weight - f.value + all.log - mass.log_all -
                   double((spikes.array() > 0).count()) * std::numbers::ln2;
  f.shared = shared_estimates(f, set.model(0), all, open);
  return f;
}

}  // namespace

Vector JointFit::residuals() const {
  std::vector<Vector> parts;
  for (const auto& c : conditions) parts.push_back(c.residuals.values);
  return stacked(parts);
}

Matrix JointFit::jacobian() const {
  Matrix j = Matrix::Zero(residuals().size(), u.size());
  Eigen::Index rows = 0;
  for (const auto& c : conditions) {
    j.middleRows(rows, c.jacobian.rows())(Eigen::all, c.which) = c.jacobian;
    rows += c.jacobian.rows();
  }
  return j;
}

JointFit fit(ConditionSet& set, const SharedPrior& shared, const Errors* errors,
             const FitOptions& options) {
  JointFit f;
  if (options.start && options.start->size() != set.size()) {
    f.message = "nothing to start from";
    return f;
  }
  JointProblem problem(set, shared, errors, options);
  f.lower = problem.lower(), f.upper = problem.upper(), f.own = problem.own();
  const Vector start = start_of(set, problem, options);
  const DescentResult r = descend(
      problem, start, {most_steps, options.precision, {}, options.give_up_above, roughness});
  f.converged = r.converged, f.message = r.message, f.iterations = r.iterations;
  if (r.u.size() == 0) return f;
  f.u = r.u, f.value = r.value;
  f.prior_rows = problem.prior_rows(), f.prior_values = problem.prior_values();
  f = with_conditions(std::move(f), set, problem);
  if (f.conditions.size() < set.size()) return f;
  return with_evidence(std::move(f), set, shared, problem);
}

}  // namespace genio
