#include "discrepancy/contest/selection_round.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "discrepancy/candidates/response.hpp"
#include "discrepancy/conditions/influence.hpp"
#include "discrepancy/contest/refit.hpp"
#include "discrepancy/contest/settled_fit.hpp"
#include "forward/base/elapsed.hpp"

namespace genio {
namespace {

// Log odds, at least and of the best, of contenders that the mesh's error may reorder: an open jaw
// gained 43 of 192 by its own.
constexpr double close = 8, close_part = 0.15;

/// The bar that the refits so far set for the next one.
struct Bar {
  double gained = 0;    // by the best contender, of log evidence
  double promised = 0;  // of that, by its score
  double give_up_above = std::numeric_limits<double>::infinity();  // minus the log posterior
};

/// A candidate's refit. Only a contender's model is of use.
struct CandidateRefit {
  RankedCandidate candidate;
  ModelFit model;
  bool contends = false;
};

/// All candidates but those found: their strengths are shared unknowns by now.
std::vector<Candidate> candidates_beside(const std::vector<Candidate>& found,
                                         const NullModel& null_model) {
  auto all = candidates(null_model.model.description, null_model.model.set->observations());
  std::erase_if(all, [&](const Candidate& c) {
    return std::any_of(found.begin(), found.end(),
                       [&](const Candidate& f) { return f.label() == c.label(); });
  });
  return all;
}

/// The candidate with the log odds of its fit over the null model's, on all data.
RankedCandidate with_odds(RankedCandidate r, const ModelFit& model, const ModelFit& null_model) {
  r.heldout_gain = model.heldout.log_evidence - null_model.heldout.log_evidence;
  r.log_odds = model.fit.log_evidence - null_model.fit.log_evidence + r.heldout_gain + r.log_prior;
  return r;
}

/// The refitted model with its held-out conditions, from where the null model's answer to it;
/// inverted anew where these do not get there. `influences`: of the null model's.
ModelFit with_heldout_answer(ModelFit m, const Candidate& candidate, const NullModel& null_model,
                             const std::vector<Matrix>& influences) {
  const JointFit& before = null_model.model.heldout;
  const auto start = with_candidate(candidate, m.fit.shared, *null_model.model.heldout_set, before,
                                    *null_model.errors.heldout, influences);
  m = with_heldout_fit(std::move(m), start, null_model.errors);
  if (!reaches_all(m.heldout, before) || (candidate.is_switch() && !improves(m.heldout, before)))
    m = with_heldout_fit(std::move(m), {}, null_model.errors);
  return m;
}

double gain_of(const ModelFit& model, const NullModel& null_model) {
  return model.fit.log_evidence - null_model.model.fit.log_evidence;
}

/// A candidate refitted on the fitted conditions and, where it is not far behind, on those held
/// out. `heldout_influences`: of these, at the null model's fit.
CandidateRefit refit_in_full(RankedCandidate r, const NullModel& null_model,
                             const std::vector<Matrix>& heldout_influences, const Bar& bar,
                             const DiscoverOptions& options) {
  options.report_progress(
      fmt::format("  refitting {}, log odds {:.1f} by its score", r.candidate.label(), r.log_odds));
  ModelFit model =
      refit(null_model.model, r.candidate, r.score, *null_model.errors.fitted, bar.give_up_above);
  r.message = model.message;
  if (!model.fitted()) {
    options.report_progress(fmt::format("    given up: {}", r.message));
    return {std::move(r), std::move(model)};
  }
  r.refitted = true;
  const double gain = gain_of(model, null_model);
  r.log_odds = gain + r.log_prior;
  if (gain < bar.gained - far_behind) return {std::move(r), std::move(model)};
  if (null_model.model.heldout_set)
    model = with_heldout_answer(std::move(model), r.candidate, null_model, heldout_influences);
  if (!reaches_all(model.heldout, null_model.model.heldout)) {
    r.message = "does not reach the conditions held out: " + model.heldout.message;
    options.report_progress("    " + r.message);
    return {std::move(r), std::move(model)};
  }
  r = with_odds(std::move(r), model, null_model.model);
  options.report_progress(
      fmt::format("    log odds {:.1f} ({:+.1f} by conditions held out), chi2 {:.0f} of {:.0f}",
                  r.log_odds, r.heldout_gain, model.chi_square, model.dof));
  return {std::move(r), std::move(model), true};
}

/// The bar after a contender's refit.
Bar raised(const Bar& bar, const CandidateRefit& refit, const SelectionRound& s) {
  const double gain = gain_of(refit.model, s.null_model);
  if (gain <= bar.gained && !s.contenders.empty()) return bar;
  return {std::max(gain, bar.gained), refit.candidate.score.log_evidence,
          refit.model.fit.value + far_behind};
}

/// The round with a candidate's refit entered.
SelectionRound with_refit(SelectionRound s, size_t candidate, CandidateRefit refit) {
  s.round.candidates[candidate] = std::move(refit.candidate);
  if (refit.contends) s.contenders.push_back({candidate, std::move(refit.model)});
  return s;
}

/// The round with another model of a contender, and the odds that go with it.
SelectionRound with_model(SelectionRound s, size_t contender, ModelFit model) {
  RankedCandidate& r = s.round.candidates[s.contenders[contender].candidate];
  r = with_odds(std::move(r), model, s.null_model.model);
  s.contenders[contender].model = std::move(model);
  return s;
}

/// The contenders by their log odds, the best first.
std::vector<size_t> by_log_odds(const SelectionRound& s) {
  std::vector<size_t> order;
  for (size_t c = 0; c < s.contenders.size(); ++c) order.push_back(c);
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return s.candidate_of(a).log_odds > s.candidate_of(b).log_odds;
  });
  return order;
}

bool is_close(double log_odds, double best) {
  return log_odds >= best - std::max(close, close_part * best);
}

}  // namespace

SelectionRound scored(const NullModel& null_model, const std::vector<Matrix>& influences,
                      const Projection& projection, const std::vector<Candidate>& found) {
  SelectionRound s;
  s.null_model = null_model;
  s.round.chi_square = null_model.model.chi_square, s.round.dof = null_model.model.dof;
  const auto all = candidates_beside(found, null_model);
  const Stopwatch watch;
  const auto scores =
      score(all, *null_model.model.set, null_model.model.fit, influences, projection);
  s.round.candidates = as_scored(all, scores, log_prior(all));
  s.round.seconds_scoring = watch.seconds();
  return s;
}

SelectionRound refitted(SelectionRound s, const DiscoverOptions& options) {
  const auto chosen = worth_a_refit(s.round.candidates, options.refits);
  const ModelFit& null_fit = s.null_model.model;
  const auto heldout_influences = null_fit.heldout_set && !chosen.empty()
                                      ? influences_of(*null_fit.heldout_set, null_fit.heldout)
                                      : std::vector<Matrix>();
  Bar bar;
  for (size_t i : chosen) {
    const RankedCandidate& r = s.round.candidates[i];
    // What a straight line puts this far behind no refit brings to the front.
    if (promises_too_little(r.score.log_evidence, bar.promised, bar.gained)) continue;
    CandidateRefit next = refit_in_full(r, s.null_model, heldout_influences, bar, options);
    if (next.contends) bar = raised(bar, next, s);
    s = with_refit(std::move(s), i, std::move(next));
  }
  return s;
}

SelectionRound weighed(SelectionRound s) {
  std::vector<double> log_odds;
  for (size_t c = 0; c < s.contenders.size(); ++c) log_odds.push_back(s.candidate_of(c).log_odds);
  const Weights weights = weigh(log_odds);
  s.round.nothing = weights.nothing, s.likeliest = weights.likeliest;
  for (size_t c = 0; c < s.contenders.size(); ++c)
    s.round.candidates[s.contenders[c].candidate].probability = weights.probabilities[c];
  return s;
}

SelectionRound with_mesh_errors(SelectionRound s, const std::vector<Candidate>& found,
                                const DiscoverOptions& options) {
  const auto order = by_log_odds(s);
  const std::string first = s.candidate_of(s.likeliest).candidate.effect;
  double best = s.candidate_of(s.likeliest).log_odds;
  if (std::none_of(order.begin(), order.end(), [&](size_t c) {
        const RankedCandidate& r = s.candidate_of(c);
        return is_close(r.log_odds, best) && r.candidate.effect != first;
      }))
    return s;
  for (size_t c : order) {
    if (!is_close(s.candidate_of(c).log_odds, best)) continue;
    std::vector<Candidate> effects = found;
    effects.push_back(s.candidate_of(c).candidate);
    ModelFit model = s.contenders[c].model;
    if (s.null_model.refinement)
      model = refit_with_mesh_error(model, s.null_model.errors,
                                    refinement_under(model, effects, *s.null_model.refinement));
    s = with_model(std::move(s), c, std::move(model));
    const RankedCandidate& r = s.candidate_of(c);
    best = std::max(best, r.log_odds);
    options.report_progress(fmt::format("  {} with the mesh's error under it: log odds {:.1f}",
                                        r.candidate.label(), r.log_odds));
  }
  return weighed(std::move(s));
}

SelectionRound against_restarted(SelectionRound s, const DiscoverOptions& options) {
  NullModel next = restarted(s.null_model, s.contenders[s.likeliest].model,
                             s.candidate_of(s.likeliest).candidate);
  const double gain = next.model.log_evidence() - s.null_model.model.log_evidence();
  s.null_model = std::move(next);
  if (gain <= 0) return s;
  options.report_progress(
      fmt::format("  the model as it is does better from there: {:+.1f}", gain));
  for (size_t c = 0; c < s.contenders.size(); ++c) {
    ModelFit model = std::move(s.contenders[c].model);
    s = with_model(std::move(s), c, std::move(model));
  }
  return weighed(std::move(s));
}

SelectionRound select_effect(const NullModel& null_model, const std::vector<Matrix>& influences,
                             const Projection& projection, const std::vector<Candidate>& found,
                             const DiscoverOptions& options) {
  SelectionRound s = weighed(refitted(scored(null_model, influences, projection, found), options));
  const auto is_found = [&] { return !s.contenders.empty() && s.round.nothing < options.nothing; };
  if (!is_found()) return s;
  s = against_restarted(with_mesh_errors(std::move(s), found, options), options);
  if (is_found()) s.winner = s.likeliest;
  return s;
}

}  // namespace genio
