#include "discrepancy/contest/null_model.hpp"

#include "discrepancy/candidates/response.hpp"
#include "discrepancy/contest/settled_fit.hpp"

namespace genio {
namespace {

/// The conditions that candidates' derivatives are taken of: unknown supports need theirs, too.
std::shared_ptr<ConditionSet> set_of(const ModelDescription& d, const Observations& o) {
  return std::make_shared<ConditionSet>(with_mobile_supports(d), o, fitted_conditions(o));
}

/// Rough fits of the conditions to fit and of those held out. All in one go: inversions of unknown
/// forces share their starts.
struct FirstGuess {
  std::vector<FittedCondition> fitted, heldout;
};

FirstGuess first_guess(const ModelDescription& description, const Observations& observations) {
  std::vector<size_t> all = fitted_conditions(observations);
  const auto count = long(all.size());
  const auto heldout = heldout_conditions(observations);
  all.insert(all.end(), heldout.begin(), heldout.end());
  ConditionSet set(description, observations, all);
  const JointFit guess = fit(set, {}, nullptr, {.precision = rough_precision});
  expect_all(set, guess);
  const auto middle = guess.conditions.begin() + count;
  return {{guess.conditions.begin(), middle}, {middle, guess.conditions.end()}};
}

/// The null model with its fitted conditions settled, from `start` on.
NullModel with_fitted_settled(NullModel null_model, JointFit start, const ErrorModel& error_model) {
  ModelFit& m = null_model.model;
  SettledFit s =
      settled(*m.set, m.shared, {std::move(start), null_model.errors.fitted, null_model.refinement},
              error_model);
  m.fit = std::move(s.fit);
  m = with_residual_test(std::move(m), *s.errors);
  null_model.errors.fitted = std::move(s.errors);
  null_model.refinement = std::move(s.refinement);
  return null_model;
}

/// The null model with the held-out conditions of `winner`, fitted at the settled parameters. Where
/// these have no fit, or one that runs away, the last one stays.
NullModel with_winners_heldout(NullModel null_model, const ModelFit& winner,
                               const ErrorModel& error_model) {
  ModelFit& m = null_model.model;
  m.heldout_set = winner.heldout_set, m.heldout = winner.heldout;
  ModelFit next = with_heldout_fit(m, m.heldout.conditions, null_model.errors);
  if (!reaches_all(next.heldout, m.heldout)) return null_model;
  m = std::move(next);
  auto [corrections, refinement] = corrections_at(*m.heldout_set, m.heldout, null_model.refinement);
  null_model.refinement = std::move(refinement);
  DataErrors errors = null_model.errors;
  errors.heldout = std::make_shared<const Errors>(
      errors_at(*m.heldout_set, m.heldout, std::move(corrections), error_model));
  next = with_heldout_fit(m, m.heldout.conditions, errors);
  if (!reaches_all(next.heldout, m.heldout) ||
      runs_away(next.heldout, *errors.heldout, m.heldout, *null_model.errors.heldout, far_behind))
    return null_model;
  m = std::move(next), null_model.errors = std::move(errors);
  return null_model;
}

/// The better of `last` and of the fit from `start`, which gives up far behind `value`.
JointFit better_from(const std::vector<FittedCondition>& start, double value, ConditionSet& set,
                     const SharedPrior& shared, const Errors& errors, const JointFit& last) {
  FitOptions options{.start = start};
  options.give_up_above = value + far_behind;
  JointFit f = fit(set, shared, &errors, options);
  return f.converged && f.log_evidence > last.log_evidence ? f : last;
}

}  // namespace

NullModel fitted_null_model(const ModelDescription& description, const Observations& observations,
                            const ErrorModel& error_model, bool correct_mesh) {
  const FirstGuess guess = first_guess(description, observations);
  NullModel null_model;
  ModelFit& m = null_model.model;
  m.description = description;
  if (correct_mesh)
    null_model.refinement = std::make_shared<const Refinement>(description, observations);
  m.set = set_of(description, observations);
  JointFit start = fit(*m.set, {}, nullptr, {.start = guess.fitted, .precision = rough_precision});
  null_model = with_fitted_settled(std::move(null_model), std::move(start), error_model);
  const auto heldout = heldout_conditions(observations);
  if (heldout.empty()) return null_model;
  m.heldout_set = std::make_shared<ConditionSet>(description, observations, heldout);
  start = fit(*m.heldout_set, {}, nullptr, {.start = guess.heldout, .precision = rough_precision});
  SettledFit s =
      settled(*m.heldout_set, {}, {std::move(start), nullptr, null_model.refinement}, error_model);
  m.heldout = std::move(s.fit), null_model.errors.heldout = std::move(s.errors);
  null_model.refinement = std::move(s.refinement);
  return null_model;
}

NullModel with_winner(const NullModel& before, const ModelFit& winner,
                      const std::vector<Candidate>& effects, const ErrorModel& error_model) {
  NullModel next = before;
  if (before.refinement)
    next.refinement = winner.refinement ? winner.refinement
                                        : refinement_under(winner, effects, *before.refinement);
  ModelFit& m = next.model;
  m.description = winner.description, m.shared = winner.shared;
  m.set = set_of(m.description, before.model.set->observations());
  JointFit start =
      fit(*m.set, m.shared, next.errors.fitted.get(), {.start = winner.fit.conditions});
  next = with_fitted_settled(std::move(next), std::move(start), error_model);
  return next.model.heldout_set ? with_winners_heldout(std::move(next), winner, error_model) : next;
}

NullModel restarted(const NullModel& before, const ModelFit& better, const Candidate& added) {
  NullModel next = before;
  ModelFit& m = next.model;
  const Errors& errors = *before.errors.fitted;
  m.fit = better_from(without_candidate(added, better.fit, errors), better.fit.value, *m.set,
                      m.shared, errors, before.model.fit);
  if (m.heldout_set && better.heldout.converged)
    m.heldout = better_from(better.heldout.conditions, better.heldout.value, *m.heldout_set, {},
                            *before.errors.heldout, before.model.heldout);
  return next;
}

}  // namespace genio
