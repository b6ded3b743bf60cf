#include "discrepancy/contest/base.hpp"

#include "discrepancy/candidates/response.hpp"
#include "discrepancy/candidates/symmetric_part.hpp"
#include "discrepancy/errors/errors.hpp"

namespace genio {
namespace {

constexpr double rough = 1, fine = 0.1;  // precision of first and last fits, of the log posterior
constexpr int most_passes = 2;           // of corrections and fits under them

void expect_all(const Study& study, const JointFit& f) {
  if (f.conditions.size() != study.size())
    throw InputError("the model does not reach the conditions: " + f.message);
}

/// The errors at a fit, and the fit under them; those it came with, if any, where that runs away.
/// Forces that made up for the mesh go back once it is corrected, and its error with them.
void settle(Study& study, const SharedPrior& shared, JointFit& f, Errors& errors,
            Refinement* refinement, const ModelDoubt& doubt) {
  const auto refit = [&](const Errors& under, double precision) {
    JointFit next = fit(study, shared, &under, {.start = &f.conditions, .precision = precision});
    expect_all(study, next);
    return next;
  };
  expect_all(study, f);
  bool rough_yet = true;
  for (int passes = 1; passes <= most_passes; ++passes) {
    const bool last = passes == most_passes;
    Errors there = errors_at(study, f, refinement, doubt);
    JointFit next = refit(there, last ? fine : rough);
    if (runs_away(next, there, f, errors, far_behind)) break;
    f = std::move(next), errors = std::move(there), rough_yet = !last;
    if (!refinement || refinement->holds(study, f)) break;
  }
  if (rough_yet) f = refit(errors, fine);
}

void settle_fitted(Base& base, const ModelDoubt& doubt) {
  Account& a = base.account;
  settle(*a.study, a.shared, a.fit, base.evidence.fitted, base.refinement.get(), doubt);
  test_residuals(a, base.evidence.fitted);
}

/// The study that candidates' derivatives are taken of: unknown supports need theirs, too.
std::shared_ptr<Study> study_of(const ModelDescription& d, const Observations& o) {
  return std::make_shared<Study>(with_mobile_supports(d), o, fitted_conditions(o));
}

std::shared_ptr<Refinement> refinement_under(const Account& a,
                                             const std::vector<Candidate>& effects,
                                             const Base& base) {
  return std::make_shared<Refinement>(symmetric_part(with_fitted(a.description, a.fit), effects),
                                      *base.refinement);
}

}  // namespace

Base fitted_base(const ModelDescription& description, const Observations& observations,
                 const DiscoverOptions& options) {
  const auto fitted = fitted_conditions(observations);
  const auto heldout = heldout_conditions(observations);
  std::vector<size_t> all = fitted;
  all.insert(all.end(), heldout.begin(), heldout.end());
  // All in one go: inversions of unknown forces share their starts.
  JointFit guess, guess_heldout;
  {
    Study study(description, observations, all);
    guess = fit(study, {}, nullptr, {.precision = rough});
    expect_all(study, guess);
  }
  const auto middle = guess.conditions.begin() + long(fitted.size());
  guess_heldout.conditions.assign(middle, guess.conditions.end());
  guess.conditions.erase(middle, guess.conditions.end());

  Base base{{}, {observations, {}, {}}, nullptr};
  Account& a = base.account;
  a.description = description;
  if (options.correct_mesh)
    base.refinement = std::make_shared<Refinement>(description, observations);
  a.study = study_of(description, observations);
  a.fit = fit(*a.study, {}, nullptr, {.start = &guess.conditions, .precision = rough});
  settle_fitted(base, options.doubt);
  if (heldout.empty()) return base;
  a.heldout_study = std::make_shared<Study>(description, observations, heldout);
  a.heldout =
      fit(*a.heldout_study, {}, nullptr, {.start = &guess_heldout.conditions, .precision = rough});
  settle(*a.heldout_study, {}, a.heldout, base.evidence.heldout, base.refinement.get(),
         options.doubt);
  return base;
}

void move_base(Base& base, const Account& winner, const std::vector<Candidate>& effects,
               const DiscoverOptions& options) {
  if (base.refinement)
    base.refinement =
        winner.refinement ? winner.refinement : refinement_under(winner, effects, base);
  Account& a = base.account;
  Evidence& evidence = base.evidence;
  a.description = winner.description, a.shared = winner.shared;
  a.study = study_of(a.description, evidence.observations);
  a.fit = fit(*a.study, a.shared, &evidence.fitted, {&winner.fit.conditions});
  settle_fitted(base, options.doubt);
  if (!a.heldout_study) return;
  // The winner's own fit stays where the settled parameters have none.
  a.heldout_study = winner.heldout_study, a.heldout = winner.heldout;
  const auto refit = [&](const Errors& under) {
    Account next = a;
    fit_heldout(next, &a.heldout.conditions, {evidence.observations, evidence.fitted, under});
    return next;
  };
  const auto keep = [&](Account next) {
    a.heldout_study = next.heldout_study, a.heldout = std::move(next.heldout);
  };
  Account next = refit(evidence.heldout);
  if (!reaches_all(next.heldout, a.heldout)) return;
  keep(std::move(next));
  Errors there = errors_at(*a.heldout_study, a.heldout, base.refinement.get(), options.doubt);
  next = refit(there);
  if (!reaches_all(next.heldout, a.heldout) ||
      runs_away(next.heldout, there, a.heldout, evidence.heldout, far_behind))
    return;
  keep(std::move(next)), evidence.heldout = std::move(there);
}

void settle_account(const Base& base, Account& account, const std::vector<Candidate>& effects) {
  if (!base.refinement) return;
  Account a = account;
  Evidence evidence = base.evidence;
  a.refinement = refinement_under(a, effects, base);
  for (int passes = 0; passes < most_passes && !a.refinement->holds(*a.study, a.fit); ++passes) {
    evidence.fitted.corrections = a.refinement->corrections(*a.study, a.fit);
    JointFit next = fit(*a.study, a.shared, &evidence.fitted, {&a.fit.conditions});
    if (!next.converged) return;
    a.fit = std::move(next);
  }
  test_residuals(a, evidence.fitted);
  if (a.heldout_study) {
    evidence.heldout.corrections = a.refinement->corrections(*a.heldout_study, a.heldout);
    fit_heldout(a, &account.heldout.conditions, evidence);
    if (!reaches_all(a.heldout, account.heldout)) return;
  }
  account = std::move(a);
}

double follow(Base& base, const Account& better, const Candidate& added) {
  Account& a = base.account;
  const double before = a.fit.log_evidence + a.heldout.log_evidence;
  const auto try_from = [](Study& study, const SharedPrior& shared, const Errors& errors,
                           const std::vector<FittedCondition>& start, double value,
                           JointFit& best) {
    FitOptions options{&start};
    options.hopeless = value + far_behind;
    JointFit f = fit(study, shared, &errors, options);
    if (f.converged && f.log_evidence > best.log_evidence) best = std::move(f);
  };
  const Errors& errors = base.evidence.fitted;
  try_from(*a.study, a.shared, errors, without(added, better.fit, errors), better.fit.value, a.fit);
  if (a.heldout_study && better.heldout.converged)
    try_from(*a.heldout_study, {}, base.evidence.heldout, better.heldout.conditions,
             better.heldout.value, a.heldout);
  return a.fit.log_evidence + a.heldout.log_evidence - before;
}

}  // namespace genio
