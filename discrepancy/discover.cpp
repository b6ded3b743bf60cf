#include "discrepancy/discover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "discrepancy/errors.hpp"
#include "discrepancy/influence.hpp"
#include "discrepancy/response.hpp"
#include "discrepancy/selection.hpp"
#include "discrepancy/symmetric_part.hpp"
#include "discrepancy/weighing.hpp"
#include "inverse/posterior.hpp"

namespace genio {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double behind = 0.4;   // of the best gain, that a score must promise for a refit
constexpr double rough = 1;      // precision of a first fit, of the log posterior
constexpr double hopeless = 30;  // log posterior behind the best
constexpr double infinity = std::numeric_limits<double>::infinity();

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cosine(const Vector& a, const Vector& b) {
  return a.size() == b.size() && a.size() > 0 ? std::abs(a.dot(b)) : 0;
}

class Search {
 public:
  Search(const ModelDescription& d, const Observations& o, const DiscoverOptions& options)
      : observations_(o), options_(options), found_(d), evidence_{o, {}, {}} {
    base_.description = d;
  }

  Discovery run() {
    const auto started = Clock::now();
    d_.noise = observations_.noise;
    begin();
    for (int round = 0; round < options_.most_effects; ++round)
      if (!search_once()) break;
    decide();
    d_.seconds = since(started);
    return std::move(d_);
  }

 private:
  void tell(const std::string& line) const {
    if (options_.progress) options_.progress(line);
  }

  /// Fits the model as it is, with the errors it may have.
  void begin() {
    const auto fitted = fitted_conditions(observations_);
    const auto heldout = heldout_conditions(observations_);
    tell(fmt::format("{} conditions to fit, {} held out", fitted.size(), heldout.size()));
    std::vector<size_t> all = fitted;
    all.insert(all.end(), heldout.begin(), heldout.end());
    JointFit guess, guess_heldout;
    {
      Study study(base_.description, observations_, all);
      guess = fit(study, {}, nullptr, {.precision = rough});
      if (guess.conditions.size() != all.size())
        throw InputError("the model does not reach the conditions: " + guess.message);
    }
    const auto middle = guess.conditions.begin() + long(fitted.size());
    guess_heldout.conditions.assign(middle, guess.conditions.end());
    guess.conditions.erase(middle, guess.conditions.end());
    if (options_.correct_mesh)
      refinement_ = std::make_unique<Refinement>(base_.description, observations_);
    base_.study =
        std::make_shared<Study>(with_mobile_supports(base_.description), observations_, fitted);
    base_.fit = fit(*base_.study, {}, nullptr, {&guess.conditions});
    settle();
    if (!heldout.empty()) {
      base_.heldout_study = std::make_shared<Study>(base_.description, observations_, heldout);
      base_.heldout = fit(*base_.heldout_study, {}, nullptr, {&guess_heldout.conditions});
      settle_heldout();
    }
    d_.before = gap_of(base_.fit, d_.noise), d_.heldout_before = gap_of(base_.heldout, d_.noise);
    d_.lines_before = lines();
    tell(fmt::format("gap {:.2f} mm ({:.2f} mm held out), noise {:.2f} mm", 1e3 * d_.before.rms,
                     1e3 * d_.heldout_before.rms, 1e3 * d_.noise));
  }

  std::vector<ShapeLine> lines() const {
    auto all = shape_lines(*base_.study, base_.fit);
    if (base_.heldout_study)
      for (auto& line : shape_lines(*base_.heldout_study, base_.heldout))
        all.push_back(std::move(line));
    return all;
  }

  /// The errors at a fit, and the fit under them. Forces that made up for the mesh go back once it
  /// is corrected, and its error with them.
  void settle(Study& study, const SharedPrior& shared, JointFit& f, Errors& errors) {
    for (int times = 0; times < 2; ++times) {
      if (f.conditions.size() != study.size())
        throw InputError("the model does not reach the conditions: " + f.message);
      errors = errors_at(study, f, refinement_.get(), options_.doubt);
      JointFit next = fit(study, shared, &errors, {&f.conditions});
      if (next.conditions.size() != study.size())
        throw InputError("the model does not reach the conditions: " + next.message);
      f = std::move(next);
      if (!refinement_ || refinement_->holds(study, f)) break;
    }
  }
  void settle() {
    settle(*base_.study, base_.shared, base_.fit, evidence_.fitted);
    const Projection projection(base_.fit, evidence_.fitted.covariance);
    base_.chi_square = projection.chi_square(), base_.dof = projection.dof();
  }
  void settle_heldout() { settle(*base_.heldout_study, {}, base_.heldout, evidence_.heldout); }

  /// Scores, refits and weighs; false when nothing more is to be named.
  bool search_once() {
    const auto started = Clock::now();
    const auto influences = influences_of(*base_.study, base_.fit);
    const Projection projection(base_.fit, evidence_.fitted.covariance);
    const auto all = candidates(base_.description, observations_);
    const auto scores = score(all, *base_.study, base_.fit, influences, projection);
    Round round;
    round.seconds_scoring = since(started);
    if (d_.rounds.empty()) {
      d_.map_before = d_.map_after = localise(*base_.study, base_.fit, evidence_.fitted.matrix);
      d_.hidden = hidden_force(*base_.study, influences, projection);
    }
    round.chi_square = base_.chi_square, round.dof = base_.dof;
    const auto prior = log_prior(all);
    std::vector<Account> accounts(scores.size());
    for (size_t i = 0; i < scores.size(); ++i)
      round.candidates.push_back({all[scores[i].candidate], scores[i], false,
                                  scores[i].log_evidence + prior[scores[i].candidate], 0, ""});
    std::vector<size_t> refitted;
    double gained = 0;  // by the best refit, of log evidence
    const Account* best_yet = nullptr;
    std::vector<Matrix> heldout_influences;  // once something is refitted
    const auto take_odds = [&](size_t i) {
      round.candidates[i].heldout_gain = heldout_gain(accounts[i]);
      round.candidates[i].log_odds = odds(accounts[i]) + prior[scores[i].candidate];
    };
    for (size_t i : worth_a_refit(all, scores, prior, options_.refits)) {
      Ranked& r = round.candidates[i];
      // What a straight line puts this far behind no refit brings to the front.
      if (scores[i].log_evidence < behind * gained) continue;
      tell(fmt::format("  refitting {}, log odds {:.1f} by its score", r.candidate.label(),
                       r.log_odds));
      accounts[i] = refit(base_, r.candidate, scores[i], evidence_,
                          best_yet ? best_yet->fit.value + hopeless : infinity);
      r.message = accounts[i].message;
      if (!accounts[i].fitted()) {
        tell(fmt::format("    given up: {}", r.message));
        continue;
      }
      r.refitted = true;
      const double gain = accounts[i].fit.log_evidence - base_.fit.log_evidence;
      r.log_odds = gain + prior[scores[i].candidate];
      if (gain < gained - hopeless) continue;
      if (base_.heldout_study) {
        if (heldout_influences.empty())
          heldout_influences = influences_of(*base_.heldout_study, base_.heldout);
        fit_heldout(accounts[i],
                    with(r.candidate, accounts[i].fit.shared, *base_.heldout_study, base_.heldout,
                         evidence_.heldout, heldout_influences),
                    evidence_);
      }
      if (accounts[i].heldout.conditions.size() != base_.heldout.conditions.size()) {
        r.message = "does not reach the conditions held out: " + accounts[i].heldout.message;
        tell("    " + r.message);
        continue;
      }
      if (gain > gained || !best_yet) gained = std::max(gain, gained), best_yet = &accounts[i];
      refitted.push_back(i);
      take_odds(i);
      tell(
          fmt::format("    log odds {:.1f} ({:+.1f} by conditions held out), chi2 {:.0f} of {:.0f}",
                      r.log_odds, r.heldout_gain, accounts[i].chi_square, accounts[i].dof));
    }
    size_t best = weigh(round, refitted);
    if (!refitted.empty() && round.nothing < options_.nothing &&
        follow(accounts[best], round.candidates[best].candidate)) {
      for (size_t i : refitted) take_odds(i);
      best = weigh(round, refitted);
    }
    const bool go_on = !refitted.empty() && round.nothing < options_.nothing;
    if (go_on) accept(round, best, accounts);
    d_.rounds.push_back(std::move(round));
    return go_on;
  }

  /// Log evidence of an account over the base's, on all data.
  double odds(const Account& a) const {
    return a.fit.log_evidence - base_.fit.log_evidence + heldout_gain(a);
  }
  double heldout_gain(const Account& a) const {
    return a.heldout.log_evidence - base_.heldout.log_evidence;
  }

  /// Lets the base start where a better account ends once what it adds goes away: it may have found
  /// a valley of the forces that has nothing to do with that. True where the base got better by it.
  bool follow(const Account& better, const Candidate& added) {
    const double before = base_.fit.log_evidence + base_.heldout.log_evidence;
    const auto try_from = [](Study& study, const SharedPrior& shared, const Errors& errors,
                             const std::vector<FittedCondition>& start, double value,
                             JointFit& best) {
      FitOptions options{&start};
      options.hopeless = value + hopeless;
      JointFit f = fit(study, shared, &errors, options);
      if (f.converged && f.log_evidence > best.log_evidence) best = std::move(f);
    };
    try_from(*base_.study, base_.shared, evidence_.fitted,
             without(added, better.fit, evidence_.fitted), better.fit.value, base_.fit);
    if (base_.heldout_study && better.heldout.converged)
      try_from(*base_.heldout_study, {}, evidence_.heldout, better.heldout.conditions,
               better.heldout.value, base_.heldout);
    const double gain = base_.fit.log_evidence + base_.heldout.log_evidence - before;
    if (gain > 0) tell(fmt::format("  the model as it is does better from there: {:+.1f}", gain));
    return gain > 0;
  }

  void accept(const Round& round, size_t best, const std::vector<Account>& accounts) {
    const Account& account = accounts[best];
    const Ranked* first = round.candidates.data();
    const Ranked& r = round.candidates[best];
    std::map<std::string, double> by_effect;
    for (const Ranked& other : round.candidates)
      by_effect[other.candidate.effect] += other.probability;
    effects_.push_back(r.candidate);
    confidence_.push_back(by_effect[r.candidate.effect]);
    for (const Ranked& other : round.candidates)
      if (other.refitted && other.candidate.effect != r.candidate.effect &&
          other.probability > 0.01)
        rivals_.push_back(
            {other.candidate.effect, other.candidate.where, other.probability,
             cosine(other.score.direction, r.score.direction),
             experiments(explanation_of(accounts[best]),
                         explanation_of(accounts[size_t(&other - first)]), observations_)});
    tell(fmt::format("  {}: probability {:.3f}", r.candidate.label(), confidence_.back()));
    if (refinement_)
      refinement_ = std::make_unique<Refinement>(
          symmetric_part(with_fitted(account.description, account.fit), effects_), *refinement_);
    // The next round's unknown supports need their derivatives too.
    base_.description = account.description, base_.shared = account.shared;
    base_.study = std::make_shared<Study>(with_mobile_supports(base_.description), observations_,
                                          fitted_conditions(observations_));
    base_.fit = fit(*base_.study, base_.shared, &evidence_.fitted, {&account.fit.conditions});
    settle();
    if (!base_.heldout_study) return;
    // The account's own fit stays where the settled parameters have none.
    base_.heldout_study = account.heldout_study, base_.heldout = account.heldout;
    for (int times = 0; times < 2; ++times) {
      Account next = base_;
      fit_heldout(next, base_.heldout.conditions, evidence_);
      if (next.heldout.conditions.size() != base_.heldout.conditions.size()) break;
      base_.heldout_study = next.heldout_study, base_.heldout = std::move(next.heldout);
      if (times == 0)
        evidence_.heldout =
            errors_at(*base_.heldout_study, base_.heldout, refinement_.get(), options_.doubt);
    }
  }

  void decide() {
    if (!effects_.empty())
      d_.map_after = localise(*base_.study, base_.fit, evidence_.fitted.matrix);
    d_.after = gap_of(base_.fit, d_.noise), d_.heldout_after = gap_of(base_.heldout, d_.noise);
    d_.lines_after = lines();
    d_.families = families(observations_, d_.rounds.front());
    d_.model = with_fitted(base_.description, base_.fit);
    d_.fit_tail = chi_square_tail(base_.chi_square / options_.doubt.dispersion, base_.dof);
    const bool explained = d_.fit_tail >= options_.fit_level;
    d_.effects = named(base_.fit, effects_, confidence_);
    d_.alternatives = rivals_;
    if (effects_.empty()) {
      d_.finding = explained ? Finding::none : Finding::unknown;
    } else if (!explained) {
      d_.finding = Finding::unknown;
    } else {
      const double least = *std::min_element(confidence_.begin(), confidence_.end());
      d_.finding = least >= options_.certain ? Finding::named : Finding::ambiguous;
    }
    d_.message = explanation(d_.finding, d_.fit_tail);
    if (d_.finding == Finding::unknown || d_.finding == Finding::none) {
      // What comes nearest is told among the alternatives, but is no name.
      for (size_t i = 0; i < effects_.size(); ++i)
        d_.alternatives.insert(d_.alternatives.begin() + long(i),
                               {effects_[i].effect, effects_[i].where, confidence_[i], 1});
      d_.effects.clear();
      d_.model = found_;
      d_.map_after = d_.map_before, d_.lines_after = d_.lines_before;
      d_.after = d_.before, d_.heldout_after = d_.heldout_before;
    }
  }

  const Observations& observations_;
  const DiscoverOptions& options_;
  ModelDescription found_;  // as given
  Account base_;
  std::unique_ptr<Refinement> refinement_;
  Evidence evidence_;
  std::vector<Candidate> effects_;
  std::vector<double> confidence_;
  std::vector<Rival> rivals_;
  Discovery d_;
};

}  // namespace

Discovery discover(const ModelDescription& description, const Observations& observations,
                   const DiscoverOptions& options) {
  return Search(description, observations, options).run();
}

}  // namespace genio
