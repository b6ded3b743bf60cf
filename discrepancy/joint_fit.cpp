#include "discrepancy/joint_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "discrepancy/joint_problem.hpp"
#include "inverse/box_gaussian.hpp"
#include "inverse/multi_start.hpp"

namespace genio {
namespace {

constexpr double interval = 1.645;  // standard deviations of a 90 % interval
constexpr int most_steps = 25;
constexpr double roughness = 1;  // of the log posterior
// Of conditions inverted by themselves:
constexpr int more_starts = 3;
constexpr double much_worse = 1.4;  // than the median misfit
constexpr double guess_tolerance = 0.02;

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
  if (!open.empty()) z(open) = prior.density().mode;
  return z;
}

/// An inversion of one condition by itself.
Answer alone(Study& study, size_t k, int starts) {
  InferOptions options;
  options.bilateral = study.bilateral(k);
  options.tolerance = guess_tolerance;
  return infer_from_starts(study.model(k), study.condition(k).target, study.prior(k),
                           study.inferring(k), options, {starts});
}

/// Inversions of the conditions of which no forces are known; empty answers for the others. One
/// that fits much worse than the rest may sit in a wrong valley and gets more starts.
std::vector<Answer> each_alone(Study& study) {
  std::vector<Answer> result(study.size());
  std::vector<double> rms;
  for (size_t k = 0; k < study.size(); ++k) {
    if (study.condition(k).forces) continue;
    result[k] = alone(study, k, 1);
    if (result[k].activations.size() > 0) rms.push_back(result[k].rms);
  }
  if (rms.empty()) return result;
  std::nth_element(rms.begin(), rms.begin() + long(rms.size() / 2), rms.end());
  for (size_t k = 0; k < study.size(); ++k)
    if (!study.condition(k).forces &&
        (result[k].activations.size() == 0 || result[k].rms > much_worse * rms[rms.size() / 2]))
      result[k] = alone(study, k, more_starts);
  return result;
}

/// The unknowns of a part as an inversion by itself has them.
Vector guessed(Study& study, size_t k, const Answer& answer, JointProblem::Part& part, Vector z) {
  if (answer.activations.size() == 0) return z;
  const auto own = unknowns(study.model(k), study.prior(k), study.bilateral(k));
  const auto& commands = part.objective.commands();
  for (size_t i = 0; i < commands.size(); ++i)
    for (size_t j = 0; j < own.size(); ++j)
      if (own[j].name == commands[i].name) z[Eigen::Index(i)] = answer.activations[Eigen::Index(j)];
  part.options.start_shape = answer.shape;
  return z;
}

Vector start_of(const FittedCondition& before, const std::vector<Command>& commands,
                const std::map<std::string, double>& shared, Vector z) {
  for (size_t i = 0; i < commands.size(); ++i) {
    const Command& c = commands[i];
    for (size_t j = 0; j < before.commands.size(); ++j)
      if (before.commands[j].name == c.name)
        z[Eigen::Index(i)] = before.z[Eigen::Index(j)] * before.commands[j].scale / c.scale;
    if (const auto s = shared.find(c.name); s != shared.end())
      z[Eigen::Index(i)] = s->second / c.scale;
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
Vector spikes_at_rest(const Study& study, const JointFit& f, const std::vector<Eigen::Index>& open,
                      const PriorMass& mass) {
  std::vector<bool> may_rest(size_t(f.u.size()), false);
  for (size_t k = 0; k < f.conditions.size(); ++k) {
    if (study.condition(k).forces) continue;
    const FittedCondition& c = f.conditions[k];
    for (size_t i = 0; i < c.commands.size(); ++i)
      if (c.commands[i].kind == Command::Kind::muscle) may_rest[size_t(c.which[i])] = true;
  }
  Vector spikes = Vector::Zero(Eigen::Index(open.size()));
  for (size_t i = 0; i < open.size(); ++i)
    if (may_rest[size_t(open[i])]) spikes[Eigen::Index(i)] = mass.each[Eigen::Index(i)];
  return spikes;
}

/// t > 0 that a density exp(-slope t - t^2 / (2 sd^2)) on t >= 0 exceeds once in ten.
double one_in_ten(double slope, double sd) {
  const auto tail = [&](double t) {
    return std::erfc((t / sd + slope * sd) / std::numbers::sqrt2);
  };
  if (slope * sd > 6) return std::numbers::ln10 / slope;
  double low = 0, high = interval * sd;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (tail(middle) > 0.1 * tail(0) ? low : high) = middle;
  }
  return low;
}

/// `open`: which unknowns the density is of. Unknowns that a bound presses on stay there, but for
/// the one that is looked at.
void summarise_shared(JointFit& f, const Model& model, const BoxGaussian& density,
                      const std::vector<Eigen::Index>& open) {
  const FittedCondition& c = f.conditions.front();
  for (size_t i = 0; i < c.commands.size(); ++i) {
    if (c.which[i] < f.own) continue;
    const Command& command = c.commands[i];
    SharedEstimate e{command.name, command.unit, c.z[Eigen::Index(i)] * command.scale};
    // Through its unit and back a value may leave a bound by a rounding error.
    for (int k : command.parameters)
      e.value = std::clamp(e.value, model.parameters[size_t(k)].info.lower,
                           model.parameters[size_t(k)].info.upper);
    e.low = e.high = e.value;
    f.shared.push_back(e);
    const auto found = std::find(open.begin(), open.end(), c.which[i]);
    if (found == open.end()) continue;
    const Eigen::Index at = found - open.begin();
    std::vector<Eigen::Index> with{at};
    for (Eigen::Index k = 0; k < density.slope.size(); ++k)
      if (k != at && pressed(density, k) == 0) with.push_back(k);
    const double sd = std::sqrt(
        density.hessian(with, with).llt().solve(Vector::Unit(Eigen::Index(with.size()), 0))[0]);
    const int side = pressed(density, at);
    const double one_sided = side == 0 ? 0 : one_in_ten(std::abs(density.slope[at]), sd);
    const double below = side == 0 ? interval * sd : side > 0 ? one_sided : 0;
    const double above = side == 0 ? interval * sd : side < 0 ? one_sided : 0;
    SharedEstimate& estimate = f.shared.back();
    estimate.sd = command.scale * (side == 0 ? sd : one_sided / std::numbers::ln10);
    estimate.low = std::max(command.lower * command.scale, e.value - command.scale * below);
    estimate.high = std::min(command.upper * command.scale, e.value + command.scale * above);
  }
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

JointFit fit(Study& study, const SharedPrior& shared, const Errors* errors,
             const FitOptions& options) {
  if (options.start && options.start->size() != study.size()) {
    JointFit nothing;
    nothing.message = "nothing to start from";
    return nothing;
  }
  JointProblem problem(study, shared, errors, options);
  JointFit f;
  f.lower = problem.lower(), f.upper = problem.upper(), f.own = problem.own();
  Vector u = Vector::Zero(f.lower.size());
  const auto answers = options.start ? std::vector<Answer>() : each_alone(study);
  for (size_t k = 0; k < problem.size(); ++k) {
    auto& part = problem.part(k);
    const Vector z = expected(part.objective.prior());
    u(part.which) = options.start ? start_of((*options.start)[k], part.objective.commands(),
                                             options.shared_start, z)
                                  : guessed(study, k, answers[k], part, z);
  }
  u = u.cwiseMax(f.lower).cwiseMin(f.upper);
  const DescentResult r =
      descend(problem, u, {most_steps, options.precision, {}, options.hopeless, roughness});
  f.converged = r.converged, f.message = r.message, f.iterations = r.iterations;
  if (r.u.size() == 0) return f;
  f.u = r.u, f.value = r.value;
  f.prior_rows = problem.prior_rows(), f.prior_values = problem.prior_values();
  for (size_t k = 0; k < problem.size(); ++k) {
    auto& part = problem.part(k);
    const Vector z = problem.of_part(f.u, k);
    const auto* p = part.objective.derivatives(z);
    if (!p) {
      f.converged = false;
      f.message = fmt::format("{}: {}", study.condition(k).name, part.objective.last_failure());
      return f;
    }
    f.conditions.push_back({part.objective.commands(), part.which, z, p->equilibrium.x,
                            p->equilibrium.parameters, p->residuals, p->jacobian});
    f.conditions.back().residuals.values = part.residuals(*p);
  }
  const auto open = open_unknowns(f.lower, f.upper);
  if (open.empty()) {
    f.log_evidence = -f.value;
    return f;
  }
  const Matrix j = problem.whitened(f.jacobian())(Eigen::all, open);
  const Matrix a = problem.prior_rows()(Eigen::all, open);
  const Matrix h = j.transpose() * j + a.transpose() * a;
  const Vector slope = j.transpose() * problem.whitened(f.residuals()).col(0) +
                       a.transpose() * (problem.prior_rows() * f.u - problem.prior_values());
  BoxGaussian density{f.u(open), slope, h, f.lower(open), f.upper(open)};
  for (Eigen::Index i = 0; i < slope.size(); ++i)
    if (pressed(density, i) == 0) density.slope[i] = 0;
  const PriorMass mass = prior_mass(f, open);
  const Vector spikes = spikes_at_rest(study, f, open, mass);
  f.log_evidence = -f.value + log_integral(density, spikes) - mass.log_all -
                   double((spikes.array() > 0).count()) * std::numbers::ln2;
  summarise_shared(f, study.model(0), density, open);
  return f;
}

}  // namespace genio
