#include "discrepancy/contest/null_model.hpp"

#include "discrepancy/candidates/response.hpp"
#include "discrepancy/candidates/symmetric_part.hpp"
#include "discrepancy/errors/errors.hpp"

namespace genio {
namespace {

constexpr double rough = 1, fine = 0.1;  // precision of first and last fits, of the log posterior
constexpr int most_passes = 2;           // of corrections and fits under them

void expect_all(const ConditionSet& set, const JointFit& f) {
  if (f.conditions.size() != set.size())
    throw InputError("the model does not reach the conditions: " + f.message);
}

/// The errors at a fit, and the fit under them; those it came with, if any, where that runs away.
/// Forces that made up for the mesh go back once it is corrected, and its error with them.
void settle(ConditionSet& set, const SharedPrior& shared, JointFit& f, Errors& errors,
            Refinement* refinement, const ErrorModel& error_model) {
  const auto refit = [&](const Errors& under, double precision) {
    JointFit next = fit(set, shared, &under, {.start = &f.conditions, .precision = precision});
    expect_all(set, next);
    return next;
  };
  expect_all(set, f);
  bool rough_yet = true;
  for (int passes = 1; passes <= most_passes; ++passes) {
    const bool last = passes == most_passes;
    Errors there = errors_at(set, f, refinement, error_model);
    JointFit next = refit(there, last ? fine : rough);
    if (runs_away(next, there, f, errors, far_behind)) break;
    f = std::move(next), errors = std::move(there), rough_yet = !last;
    if (!refinement || refinement->holds(set, f)) break;
  }
  if (rough_yet) f = refit(errors, fine);
}

void settle_fitted(NullModel& base, const ErrorModel& error_model) {
  ModelFit& a = base.account;
  settle(*a.set, a.shared, a.fit, base.evidence.fitted, base.refinement.get(), error_model);
  with_residual_test(a, base.evidence.fitted);
}

/// The study that candidates' derivatives are taken of: unknown supports need theirs, too.
std::shared_ptr<ConditionSet> study_of(const ModelDescription& d, const Observations& o) {
  return std::make_shared<ConditionSet>(with_mobile_supports(d), o, fitted_conditions(o));
}

std::shared_ptr<Refinement> refinement_under(const ModelFit& a,
                                             const std::vector<Candidate>& effects,
                                             const NullModel& base) {
  return std::make_shared<Refinement>(symmetric_part(with_fitted(a.description, a.fit), effects),
                                      *base.refinement);
}

}  // namespace

NullModel fitted_null_model(const ModelDescription& description, const Observations& observations,
                            const DiscoverOptions& options) {
  const auto fitted = fitted_conditions(observations);
  const auto heldout = heldout_conditions(observations);
  std::vector<size_t> all = fitted;
  all.insert(all.end(), heldout.begin(), heldout.end());
  // All in one go: inversions of unknown forces share their starts.
  JointFit guess, guess_heldout;
  {
    ConditionSet set(description, observations, all);
    guess = fit(set, {}, nullptr, {.precision = rough});
    expect_all(set, guess);
  }
  const auto middle = guess.conditions.begin() + long(fitted.size());
  guess_heldout.conditions.assign(middle, guess.conditions.end());
  guess.conditions.erase(middle, guess.conditions.end());

  NullModel base{{}, {observations, {}, {}}, nullptr};
  ModelFit& a = base.account;
  a.description = description;
  if (options.correct_mesh)
    base.refinement = std::make_shared<Refinement>(description, observations);
  a.set = study_of(description, observations);
  a.fit = fit(*a.set, {}, nullptr, {.start = &guess.conditions, .precision = rough});
  settle_fitted(base, options.error_model);
  if (heldout.empty()) return base;
  a.heldout_set = std::make_shared<ConditionSet>(description, observations, heldout);
  a.heldout =
      fit(*a.heldout_set, {}, nullptr, {.start = &guess_heldout.conditions, .precision = rough});
  settle(*a.heldout_set, {}, a.heldout, base.evidence.heldout, base.refinement.get(),
         options.error_model);
  return base;
}

void adopted(NullModel& base, const ModelFit& winner, const std::vector<Candidate>& effects,
             const DiscoverOptions& options) {
  if (base.refinement)
    base.refinement =
        winner.refinement ? winner.refinement : refinement_under(winner, effects, base);
  ModelFit& a = base.account;
  DataErrors& evidence = base.evidence;
  a.description = winner.description, a.shared = winner.shared;
  a.set = study_of(a.description, evidence.observations);
  a.fit = fit(*a.set, a.shared, &evidence.fitted, {&winner.fit.conditions});
  settle_fitted(base, options.error_model);
  if (!a.heldout_set) return;
  // The winner's own fit stays where the settled parameters have none.
  a.heldout_set = winner.heldout_set, a.heldout = winner.heldout;
  const auto refit = [&](const Errors& under) {
    ModelFit next = a;
    with_heldout_fit(next, &a.heldout.conditions, {evidence.observations, evidence.fitted, under});
    return next;
  };
  const auto keep = [&](ModelFit next) {
    a.heldout_set = next.heldout_set, a.heldout = std::move(next.heldout);
  };
  ModelFit next = refit(evidence.heldout);
  if (!reaches_all(next.heldout, a.heldout)) return;
  keep(std::move(next));
  Errors there = errors_at(*a.heldout_set, a.heldout, base.refinement.get(), options.error_model);
  next = refit(there);
  if (!reaches_all(next.heldout, a.heldout) ||
      runs_away(next.heldout, there, a.heldout, evidence.heldout, far_behind))
    return;
  keep(std::move(next)), evidence.heldout = std::move(there);
}

void with_mesh_error(const NullModel& base, ModelFit& account,
                     const std::vector<Candidate>& effects) {
  if (!base.refinement) return;
  ModelFit a = account;
  DataErrors evidence = base.evidence;
  a.refinement = refinement_under(a, effects, base);
  for (int passes = 0; passes < most_passes && !a.refinement->holds(*a.set, a.fit); ++passes) {
    evidence.fitted.corrections = a.refinement->corrections(*a.set, a.fit);
    JointFit next = fit(*a.set, a.shared, &evidence.fitted, {&a.fit.conditions});
    if (!next.converged) return;
    a.fit = std::move(next);
  }
  with_residual_test(a, evidence.fitted);
  if (a.heldout_set) {
    evidence.heldout.corrections = a.refinement->corrections(*a.heldout_set, a.heldout);
    with_heldout_fit(a, &account.heldout.conditions, evidence);
    if (!reaches_all(a.heldout, account.heldout)) return;
  }
  account = std::move(a);
}

double restarted(NullModel& base, const ModelFit& better, const Candidate& added) {
  ModelFit& a = base.account;
  const double before = a.fit.log_evidence + a.heldout.log_evidence;
  const auto try_from = [](ConditionSet& set, const SharedPrior& shared, const Errors& errors,
                           const std::vector<FittedCondition>& start, double value,
                           JointFit& best) {
    FitOptions options{&start};
    options.give_up_above = value + far_behind;
    JointFit f = fit(set, shared, &errors, options);
    if (f.converged && f.log_evidence > best.log_evidence) best = std::move(f);
  };
  const Errors& errors = base.evidence.fitted;
  try_from(*a.set, a.shared, errors, without_candidate(added, better.fit, errors), better.fit.value,
           a.fit);
  if (a.heldout_set && better.heldout.converged)
    try_from(*a.heldout_set, {}, base.evidence.heldout, better.heldout.conditions,
             better.heldout.value, a.heldout);
  return a.fit.log_evidence + a.heldout.log_evidence - before;
}

}  // namespace genio
