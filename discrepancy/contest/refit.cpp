#include "discrepancy/contest/refit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "discrepancy/candidates/response.hpp"

namespace genio {
namespace {

constexpr double far_start = 2, near_start = 0.1;  // typical strengths
constexpr double misjudged = 1.5;                  // scale of strengths, by this factor
constexpr int most_rescales = 3;

/// What a refit is of, and where it stops.
struct Task {
  const ModelFit& null_model;
  const Candidate& candidate;
  const Score& score;
  const Errors& errors;
  double give_up_above;
};

/// Starting values of a candidate's numbers, in their own unit.
std::map<ParameterName, double> starts(const Candidate& c, const Score& s, double farthest) {
  std::map<ParameterName, double> result;
  for (size_t i = 0; i < c.strengths.size(); ++i) {
    const FreeNumber& n = c.strengths[i];
    const double least = 0.05 * n.belief.typical;  // off the kink of a one-sided one
    // A straight line may point far beyond where it holds.
    double off = std::clamp(n.off(s.estimate[Eigen::Index(i)]), -farthest * n.belief.typical,
                            farthest * n.belief.typical);
    if (std::abs(off) < least) off = n.info.absent < n.info.upper ? least : -least;
    result[c.name_of(n)] = std::clamp(n.at(off), n.info.lower, n.info.upper);
  }
  return result;
}

/// What a candidate's numbers are believed to be, strong ones by `scale`, beside those of `shared`.
SharedPrior believed(SharedPrior shared, const Candidate& c, double scale) {
  if (!c.hypothesis) {
    shared.head_pose = HeadPosePrior{scale * c.strengths.front().belief.typical,
                                     scale * c.strengths.back().belief.typical};
  } else {
    const auto add = [&](const std::vector<FreeNumber>& numbers, double by) {
      for (const FreeNumber& n : numbers)
        shared.parameters[c.name_of(n)] = {
            {n.info.absent, by * n.belief.typical}, n.info.lower, n.info.upper, n.belief.ratio};
    };
    add(c.hypothesis->strengths, scale), add(c.hypothesis->details, 1);
  }
  shared.log_weight += log_weight_of_scale(scale);
  return shared;
}

/// How many times its typical strength a candidate has, at least 1.
double scale_of(const Candidate& c, const JointFit& fit) {
  double scale = 1;
  for (const FreeNumber& n : c.strengths)
    for (const SharedEstimate& e : fit.shared)
      if (e.name == c.name_of(n))
        scale = std::max(scale, std::abs(n.off(e.value)) / n.belief.typical);
  return scale;
}

std::map<ParameterName, double> values_of(const JointFit& fit) {
  std::map<ParameterName, double> result;
  for (const SharedEstimate& e : fit.shared) result[e.name] = e.value;
  return result;
}

/// The fit from strengths of at most `farthest` typical ones, and from where the commands, to first
/// order, answer to them.
JointFit fit_from(const ModelFit& m, const Task& task, double farthest) {
  const Candidate& candidate = task.candidate;
  FitOptions options;
  options.shared_start = starts(candidate, task.score, farthest);
  Vector step(task.score.signature.cols());
  for (size_t i = 0; i < candidate.strengths.size(); ++i) {
    const FreeNumber& n = candidate.strengths[i];
    step[Eigen::Index(i)] = n.off(options.shared_start.at(candidate.name_of(n)));
  }
  const auto start = response(task.null_model.fit, task.errors, task.score.signature * step);
  options.start = start;
  options.give_up_above = task.give_up_above;
  return fit(*m.set, m.shared, &task.errors, options);
}

/// The fit from where the score points, or from nearer where no equilibrium is that far.
JointFit first_fit(const ModelFit& m, const Task& task) {
  std::vector<double> reaches{far_start, near_start};
  if (task.score.scale > 1) reaches.insert(reaches.begin(), far_start * task.score.scale);
  JointFit f;
  for (double farthest : reaches)
    if (f = fit_from(m, task, farthest); f.u.size() > 0) break;
  return f;
}

/// Fits again while the strengths turn out to be of another scale than was believed.
ModelFit rescaled(ModelFit m, const Task& task) {
  double scale = task.score.scale;
  for (int tries = 0; tries < most_rescales && m.fit.converged; ++tries) {
    const double now = scale_of(task.candidate, m.fit);
    if (now < misjudged * scale && scale < misjudged * now) break;
    scale = now;
    m.shared = believed(task.null_model.shared, task.candidate, scale);
    FitOptions options{m.fit.conditions, values_of(m.fit)};
    options.give_up_above = task.give_up_above;
    m.fit = fit(*m.set, m.shared, &task.errors, options);
  }
  return m;
}

/// Every condition inverted anew, where that succeeds.
ModelFit inverted_anew(ModelFit m, const Task& task) {
  FitOptions options;
  options.give_up_above = task.give_up_above;
  if (JointFit f = fit(*m.set, m.shared, &task.errors, options); f.converged) m.fit = std::move(f);
  return m;
}

/// What no such effect does and this one would; empty: nothing.
std::string implausible(const Candidate& c, const ModelFit& fitted) {
  const Model& m = fitted.set->model(0);
  for (size_t e = 0; e < m.effects.size(); ++e)
    if (m.effects[e].name() == c.effect)
      return genio::implausible(
          c.effect, effect_parameters(m, fitted.fit.conditions.front().parameters, int(e)));
  return {};
}

/// The model that is to be fitted: the null model's description and beliefs with the candidate's.
ModelFit with_candidate_added(const Task& task) {
  ModelFit m;
  m.description = task.null_model.description, m.shared = task.null_model.shared;
  const bool is_switch = task.candidate.is_switch();
  if (task.candidate.hypothesis)
    m.description = task.candidate.hypothesis->added_to(std::move(m.description), is_switch);
  if (!is_switch) m.shared = believed(m.shared, task.candidate, task.score.scale);
  return m;
}

/// Throws InputError where the model cannot be built.
ModelFit fitted(ModelFit m, const Task& task) {
  const Observations& observations = task.null_model.set->observations();
  m.set =
      std::make_shared<ConditionSet>(m.description, observations, fitted_conditions(observations));
  m.fit = first_fit(m, task);
  if (!task.candidate.is_switch()) m = rescaled(std::move(m), task);
  else if (!improves(m.fit, task.null_model.fit)) m = inverted_anew(std::move(m), task);
  m.message = m.fit.message;
  if (!m.fit.converged) return m;
  if (const auto what = implausible(task.candidate, m); !what.empty())
    m.fit.converged = false, m.message = "it would " + what;
  return m;
}

}  // namespace

ModelFit refit(const ModelFit& null_model, const Candidate& candidate, const Score& score,
               const Errors& errors, double give_up_above) {
  const Task task{null_model, candidate, score, errors, give_up_above};
  ModelFit m = with_candidate_added(task);
  try {
    m = fitted(std::move(m), task);
  } catch (const InputError& e) {
    m.fit.converged = false, m.message = e.what();
  }
  return m.fitted() ? with_residual_test(std::move(m), errors) : m;
}

}  // namespace genio
