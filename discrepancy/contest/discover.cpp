#include "discrepancy/contest/discover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discrepancy/conditions/influence.hpp"
#include "discrepancy/contest/selection_round.hpp"
#include "forward/base/elapsed.hpp"
#include "inverse/posterior/distributions.hpp"

namespace genio {
namespace {

constexpr double worth_a_line = 0.01;  // probability of an alternative that is reported

/// What the rounds so far have come to.
struct Search {
  NullModel null_model;
  std::vector<Candidate> effects;  // added, one after another
  std::vector<double> confidence;  // of each
  Discovery discovery;
  bool over = false;  // nothing more is to be named
};

double cosine(const Vector& a, const Vector& b) {
  return a.size() == b.size() && a.size() > 0 ? std::abs(a.dot(b)) : 0;
}

std::vector<ShapeLine> lines(const ModelFit& m) {
  auto all = shape_lines(*m.set, m.fit);
  if (m.heldout_set)
    for (auto& line : shape_lines(*m.heldout_set, m.heldout)) all.push_back(std::move(line));
  return all;
}

ResidualMap map_of(const NullModel& n) {
  return localise(*n.model.set, n.model.fit, n.errors.fitted->matrix);
}

Search started(const ModelDescription& description, const Observations& observations,
               const DiscoverOptions& options) {
  Search s;
  s.null_model =
      fitted_null_model(description, observations, options.error_model, options.correct_mesh);
  Discovery& d = s.discovery;
  d.noise = observations.noise;
  d.before = gap_of(s.null_model.model.fit, d.noise);
  d.heldout_before = gap_of(s.null_model.model.heldout, d.noise);
  d.lines_before = lines(s.null_model.model);
  options.report_progress(fmt::format("gap {:.2f} mm ({:.2f} mm held out), noise {:.2f} mm",
                                      1e3 * d.before.rms, 1e3 * d.heldout_before.rms,
                                      1e3 * d.noise));
  return s;
}

/// Probability of the winner's effect, wherever it is.
double confidence_in_winner(const SelectionRound& r) {
  double probability = 0;
  for (const RankedCandidate& c : r.round.candidates)
    if (c.candidate.effect == r.candidate_of(*r.winner).candidate.effect)
      probability += c.probability;
  return probability;
}

/// The winner's likely alternatives, in the order of their scores.
std::vector<AlternativeEffect> alternatives_of(const SelectionRound& r) {
  const RankedCandidate& best = r.candidate_of(*r.winner);
  const Observations& observations = r.null_model.model.set->observations();
  std::vector<size_t> by_score(r.contenders.size());
  std::iota(by_score.begin(), by_score.end(), size_t(0));
  std::sort(by_score.begin(), by_score.end(), [&](size_t a, size_t b) {
    return r.contenders[a].candidate < r.contenders[b].candidate;
  });
  std::vector<AlternativeEffect> result;
  for (size_t c : by_score) {
    const RankedCandidate& other = r.candidate_of(c);
    if (other.candidate.effect == best.candidate.effect || other.probability <= worth_a_line)
      continue;
    result.push_back({other.candidate.effect, other.candidate.where, other.probability,
                      cosine(other.score.direction, best.score.direction),
                      experiments(posed_model_of(r.contenders[*r.winner].model),
                                  posed_model_of(r.contenders[c].model), observations)});
  }
  return result;
}

/// The search with a round's winner added to the model.
Search with_winner_added(Search s, const SelectionRound& r, const DiscoverOptions& options) {
  const Candidate& winner = r.candidate_of(*r.winner).candidate;
  s.effects.push_back(winner);
  s.confidence.push_back(confidence_in_winner(r));
  for (AlternativeEffect& a : alternatives_of(r)) s.discovery.alternatives.push_back(std::move(a));
  options.report_progress(
      fmt::format("  {}: probability {:.3f}", winner.label(), s.confidence.back()));
  s.null_model =
      with_winner(r.null_model, r.contenders[*r.winner].model, s.effects, options.error_model);
  return s;
}

/// The search after one round more.
Search after_round(Search s, const DiscoverOptions& options) {
  const Stopwatch watch;
  const ModelFit& m = s.null_model.model;
  const auto influences = influences_of(*m.set, m.fit);
  const Projection projection(m.fit, s.null_model.errors.fitted->covariance);
  const double seconds = watch.seconds();
  if (s.discovery.rounds.empty()) {
    s.discovery.map_before = s.discovery.map_after = map_of(s.null_model);
    s.discovery.hidden = hidden_force(*m.set, influences, projection);
  }
  SelectionRound r = select_effect(s.null_model, influences, projection, s.effects, options);
  r.round.seconds_scoring += seconds;
  s.over = !r.winner;
  if (r.winner) s = with_winner_added(std::move(s), r, options);
  else s.null_model = std::move(r.null_model);
  r.round.candidates = ranked(std::move(r.round.candidates));
  s.discovery.rounds.push_back(std::move(r.round));
  return s;
}

/// What comes nearest is listed among the alternatives, but is no name.
Discovery without_a_name(Discovery d, const Search& s, const ModelDescription& as_given) {
  for (size_t i = 0; i < s.effects.size(); ++i)
    d.alternatives.insert(d.alternatives.begin() + long(i),
                          {s.effects[i].effect, s.effects[i].where, s.confidence[i], 1});
  d.effects.clear();
  d.model = as_given;
  d.map_after = d.map_before, d.lines_after = d.lines_before;
  d.after = d.before, d.heldout_after = d.heldout_before;
  return d;
}

Discovery concluded(const Search& s, const ModelDescription& as_given,
                    const DiscoverOptions& options) {
  const ModelFit& m = s.null_model.model;
  Discovery d = s.discovery;
  if (!s.effects.empty()) d.map_after = map_of(s.null_model);
  d.after = gap_of(m.fit, d.noise);
  d.heldout_after = gap_of(m.heldout, d.noise);
  d.lines_after = lines(m);
  d.confounded_sets = confounded_sets(m.set->observations(), d.rounds.front());
  d.model = with_fitted(m.description, m.fit);
  d.fit_tail = chi_square_tail(m.chi_square, m.dof);
  if (!m.heldout.conditions.empty()) {
    const Projection heldout(m.heldout, s.null_model.errors.heldout->covariance);
    d.heldout_tail = chi_square_tail(heldout.chi_square(), heldout.dof());
  }
  d.effects = named(m.fit, s.effects, s.confidence, options.error_model);
  d.verdict = verdict_of(s.confidence, d.fit_tail, d.heldout_tail, options);
  d.message = message_of(d.verdict, d.fit_tail, d.heldout_tail);
  const bool has_name =
      d.verdict == DiscoveryVerdict::named || d.verdict == DiscoveryVerdict::ambiguous;
  return has_name ? d : without_a_name(std::move(d), s, as_given);
}

}  // namespace

DiscoveryVerdict verdict_of(const std::vector<double>& confidence, double fit_tail,
                            double heldout_tail, const DiscoverOptions& options) {
  if (fit_tail < options.fit_level) return DiscoveryVerdict::unknown;
  // What only the conditions held out show no search could find, but there it is.
  if (confidence.empty())
    return heldout_tail < options.fit_level ? DiscoveryVerdict::unknown : DiscoveryVerdict::none;
  const double least = *std::min_element(confidence.begin(), confidence.end());
  return least >= options.certain ? DiscoveryVerdict::named : DiscoveryVerdict::ambiguous;
}

Discovery discover(const ModelDescription& description, const Observations& observations,
                   const DiscoverOptions& options) {
  const Stopwatch watch;
  options.report_progress(fmt::format("{} conditions to fit, {} held out",
                                      fitted_conditions(observations).size(),
                                      heldout_conditions(observations).size()));
  Search s = started(description, observations, options);
  for (int round = 0; round < options.most_effects && !s.over; ++round)
    s = after_round(std::move(s), options);
  Discovery d = concluded(s, description, options);
  d.seconds = watch.seconds();
  return d;
}

}  // namespace genio
