#include "discrepancy/contest/settled_fit.hpp"

#include "discrepancy/candidates/symmetric_part.hpp"

namespace genio {
namespace {

constexpr int most_passes = 2;  // of corrections and fits under them

JointFit fit_of_all(ConditionSet& set, const SharedPrior& shared, const Errors& errors,
                    const JointFit& start, double precision) {
  JointFit next = fit(set, shared, &errors, {.start = start.conditions, .precision = precision});
  expect_all(set, next);
  return next;
}

std::shared_ptr<const Errors> with_corrections(const Errors& errors, Corrections corrections) {
  auto corrected = std::make_shared<Errors>(errors);
  corrected->corrections = std::move(corrections);
  return corrected;
}

}  // namespace

void expect_all(const ConditionSet& set, const JointFit& f) {
  if (f.conditions.size() != set.size())
    throw InputError("the model does not reach the conditions: " + f.message);
}

SettledFit settled(ConditionSet& set, const SharedPrior& shared, SettledFit s,
                   const ErrorModel& error_model) {
  expect_all(set, s.fit);
  bool rough_yet = true;
  for (int passes = 1; passes <= most_passes; ++passes) {
    const bool last = passes == most_passes;
    auto [corrections, refinement] = corrections_at(set, s.fit, s.refinement);
    s.refinement = std::move(refinement);
    const auto there =
        std::make_shared<const Errors>(errors_at(set, s.fit, std::move(corrections), error_model));
    JointFit next = fit_of_all(set, shared, *there, s.fit, last ? fine_precision : rough_precision);
    if (s.errors && runs_away(next, *there, s.fit, *s.errors, far_behind)) break;
    s.fit = std::move(next), s.errors = there, rough_yet = !last;
    if (!s.refinement || s.refinement->holds(set, s.fit)) break;
  }
  if (rough_yet) s.fit = fit_of_all(set, shared, *s.errors, s.fit, fine_precision);
  return s;
}

std::shared_ptr<const Refinement> refinement_under(const ModelFit& m,
                                                   const std::vector<Candidate>& effects,
                                                   const Refinement& before) {
  return std::make_shared<const Refinement>(
      symmetric_part(with_fitted(m.description, m.fit), effects), before);
}

ModelFit refit_with_mesh_error(const ModelFit& as_refitted, const DataErrors& errors,
                               std::shared_ptr<const Refinement> refinement) {
  ModelFit m = as_refitted;
  m.refinement = std::move(refinement);
  DataErrors under = errors;
  for (int passes = 0; passes < most_passes && !m.refinement->holds(*m.set, m.fit); ++passes) {
    auto [corrections, known] = corrections_at(*m.set, m.fit, m.refinement);
    m.refinement = std::move(known);
    under.fitted = with_corrections(*under.fitted, std::move(corrections));
    JointFit next = fit(*m.set, m.shared, under.fitted.get(), {.start = m.fit.conditions});
    if (!next.converged) return as_refitted;
    m.fit = std::move(next);
  }
  m = with_residual_test(std::move(m), *under.fitted);
  if (!m.heldout_set) return m;
  auto [corrections, known] = corrections_at(*m.heldout_set, m.heldout, m.refinement);
  m.refinement = std::move(known);
  under.heldout = with_corrections(*under.heldout, std::move(corrections));
  m = with_heldout_fit(std::move(m), as_refitted.heldout.conditions, under);
  return reaches_all(m.heldout, as_refitted.heldout) ? m : as_refitted;
}

}  // namespace genio
