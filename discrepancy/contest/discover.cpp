#include "discrepancy/contest/discover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "discrepancy/conditions/influence.hpp"
#include "discrepancy/contest/null_model.hpp"
#include "discrepancy/contest/selection_round.hpp"
#include "discrepancy/contest/weighing.hpp"
#include "inverse/posterior/posterior.hpp"

namespace genio {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cosine(const Vector& a, const Vector& b) {
  return a.size() == b.size() && a.size() > 0 ? std::abs(a.dot(b)) : 0;
}

std::vector<ShapeLine> lines(const ModelFit& a) {
  auto all = shape_lines(*a.set, a.fit);
  if (a.heldout_set)
    for (auto& line : shape_lines(*a.heldout_set, a.heldout)) all.push_back(std::move(line));
  return all;
}

class Search {
 public:
  Search(const ModelDescription& d, const Observations& o, const DiscoverOptions& options)
      : options_(options), found_(d), base_(fitted_null_model(d, o, options)) {
    d_.noise = o.noise;
    d_.before = gap_of(account().fit, d_.noise);
    d_.heldout_before = gap_of(account().heldout, d_.noise);
    d_.lines_before = lines(account());
    report_progress(fmt::format("gap {:.2f} mm ({:.2f} mm held out), noise {:.2f} mm",
                                1e3 * d_.before.rms, 1e3 * d_.heldout_before.rms, 1e3 * d_.noise));
  }

  Discovery run() {
    for (int round = 0; round < options_.most_effects; ++round)
      if (!search_once()) break;
    decide();
    return std::move(d_);
  }

 private:
  const ModelFit& account() const { return base_.account; }
  const Observations& observations() const { return base_.evidence.observations; }
  ResidualMap map() const {
    return localise(*account().set, account().fit, base_.evidence.fitted.matrix);
  }

  void report_progress(const std::string& line) const {
    if (options_.progress) options_.progress(line);
  }

  /// One round; false when nothing more is to be named.
  bool search_once() {
    const auto started = Clock::now();
    const auto influences = influences_of(*account().set, account().fit);
    const Projection projection(account().fit, base_.evidence.fitted.covariance);
    const double seconds = since(started);
    if (d_.rounds.empty()) {
      d_.map_before = d_.map_after = map();
      d_.hidden = hidden_force(*account().set, influences, projection);
    }
    SelectionRound c = contest(base_, influences, projection, effects_, options_);
    c.round.seconds_scoring += seconds;
    if (c.won) accept(c);
    rank(c.round);
    d_.rounds.push_back(std::move(c.round));
    return c.won;
  }

  void accept(const SelectionRound& c) {
    const auto& all = c.round.candidates;
    const RankedCandidate& best = all[c.best];
    double probability = 0;  // of the effect, wherever it is
    for (const RankedCandidate& r : all)
      if (r.candidate.effect == best.candidate.effect) probability += r.probability;
    effects_.push_back(best.candidate);
    confidence_.push_back(probability);
    for (size_t i = 0; i < all.size(); ++i) {
      const RankedCandidate& r = all[i];
      if (!r.refitted || r.candidate.effect == best.candidate.effect || r.probability <= 0.01)
        continue;
      d_.alternatives.push_back({r.candidate.effect, r.candidate.where, r.probability,
                                 cosine(r.score.direction, best.score.direction),
                                 experiments(posed_model_of(c.accounts[c.best]),
                                             posed_model_of(c.accounts[i]), observations())});
    }
    report_progress(fmt::format("  {}: probability {:.3f}", best.candidate.label(), probability));
    adopted(base_, c.accounts[c.best], effects_, options_);
  }

  void decide() {
    if (!effects_.empty()) d_.map_after = map();
    d_.after = gap_of(account().fit, d_.noise);
    d_.heldout_after = gap_of(account().heldout, d_.noise);
    d_.lines_after = lines(account());
    d_.confounded_sets = confounded_sets(observations(), d_.rounds.front());
    d_.model = with_fitted(account().description, account().fit);
    d_.fit_tail = chi_square_tail(account().chi_square, account().dof);
    if (!account().heldout.conditions.empty()) {
      const Projection heldout(account().heldout, base_.evidence.heldout.covariance);
      d_.heldout_tail = chi_square_tail(heldout.chi_square(), heldout.dof());
    }
    d_.effects = named(account().fit, effects_, confidence_, options_.error_model);
    const bool explained = d_.fit_tail >= options_.fit_level;
    if (effects_.empty()) {
      // What only the conditions held out show no search could find, but there it is.
      const bool everywhere = explained && d_.heldout_tail >= options_.fit_level;
      d_.verdict = everywhere ? DiscoveryVerdict::none : DiscoveryVerdict::unknown;
    } else if (!explained) {
      d_.verdict = DiscoveryVerdict::unknown;
    } else {
      const double least = *std::min_element(confidence_.begin(), confidence_.end());
      d_.verdict =
          least >= options_.certain ? DiscoveryVerdict::named : DiscoveryVerdict::ambiguous;
    }
    d_.message = message_of(d_.verdict, d_.fit_tail, d_.heldout_tail);
    if (d_.verdict == DiscoveryVerdict::unknown || d_.verdict == DiscoveryVerdict::none)
      name_nothing();
  }

  /// What comes nearest is told among the alternatives, but is no name.
  void name_nothing() {
    for (size_t i = 0; i < effects_.size(); ++i)
      d_.alternatives.insert(d_.alternatives.begin() + long(i),
                             {effects_[i].effect, effects_[i].where, confidence_[i], 1});
    d_.effects.clear();
    d_.model = found_;
    d_.map_after = d_.map_before, d_.lines_after = d_.lines_before;
    d_.after = d_.before, d_.heldout_after = d_.heldout_before;
  }

  const DiscoverOptions& options_;
  ModelDescription found_;  // as given
  NullModel base_;
  std::vector<Candidate> effects_;
  std::vector<double> confidence_;
  Discovery d_;
};

}  // namespace

Discovery discover(const ModelDescription& description, const Observations& observations,
                   const DiscoverOptions& options) {
  const auto started = Clock::now();
  if (options.progress)
    options.progress(fmt::format("{} conditions to fit, {} held out",
                                 fitted_conditions(observations).size(),
                                 heldout_conditions(observations).size()));
  Discovery d = Search(description, observations, options).run();
  d.seconds = since(started);
  return d;
}

}  // namespace genio
