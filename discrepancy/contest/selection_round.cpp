#include "discrepancy/contest/selection_round.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "discrepancy/candidates/response.hpp"
#include "discrepancy/conditions/influence.hpp"
#include "discrepancy/contest/weighing.hpp"

namespace genio {
namespace {

constexpr double behind = 0.4;  // of the best gain, that a score must promise for a refit
// Log odds, at least and of the best, of accounts that the mesh's error may reorder: an open jaw
// gained 43 of 192 by its own.
constexpr double close = 8, close_part = 0.15;
constexpr double infinity = std::numeric_limits<double>::infinity();

class Refits {
 public:
  Refits(NullModel& base, SelectionRound& contest, const std::vector<Candidate>& found,
         const DiscoverOptions& options)
      : base_(base),
        contest_(contest),
        options_(options),
        all_(candidates(base.account.description, base.evidence.observations)) {
    // Its strength is a shared unknown by now.
    std::erase_if(all_, [&](const Candidate& c) {
      return std::any_of(found.begin(), found.end(),
                         [&](const Candidate& f) { return f.label() == c.label(); });
    });
    prior_ = log_prior(all_);
  }

  /// Scores and prior odds of all candidates.
  void score(const std::vector<Matrix>& influences, const Projection& projection) {
    scores_ = genio::score(all_, *base_.account.set, base_.account.fit, influences, projection);
    contest_.accounts.resize(scores_.size());
    for (const Score& s : scores_)
      contest_.round.candidates.push_back(
          {all_[s.candidate], s, false, s.log_evidence + prior_[s.candidate], 0, ""});
  }

  void refit_best() {
    for (size_t i : worth_a_refit(all_, scores_, prior_, options_.refits)) {
      // What a straight line puts this far behind no refit brings to the front.
      if (scores_[i].log_evidence < behind * gained_) continue;
      refit_one(i);
    }
  }

  void decide(const std::vector<Candidate>& found) {
    Round& round = contest_.round;
    contest_.best = weigh(round, refitted_);
    if (refitted_.empty() || round.nothing >= options_.nothing) return;
    part_close_ones(found);
    const double gain = restarted(base_, contest_.accounts[contest_.best],
                                  round.candidates[contest_.best].candidate);
    if (gain > 0) {
      report_progress(fmt::format("  the model as it is does better from there: {:+.1f}", gain));
      for (size_t i : refitted_) take_odds(i);
      contest_.best = weigh(round, refitted_);
    }
    contest_.won = round.nothing < options_.nothing;
  }

 private:
  /// Where different effects come close, the mesh's error under each of them decides. The best
  /// comes first: who is right gains most by it, and leaves fewer close.
  void part_close_ones(const std::vector<Candidate>& found) {
    const auto& all = contest_.round.candidates;
    std::vector<size_t> order = refitted_;
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return all[a].log_odds > all[b].log_odds; });
    double best = all[contest_.best].log_odds;
    const auto is_close = [&](size_t i) {
      return all[i].log_odds >= best - std::max(close, close_part * best);
    };
    if (std::none_of(order.begin(), order.end(), [&](size_t i) {
          return is_close(i) && all[i].candidate.effect != all[contest_.best].candidate.effect;
        }))
      return;
    for (size_t i : order) {
      if (!is_close(i)) continue;
      std::vector<Candidate> effects = found;
      effects.push_back(all[i].candidate);
      with_mesh_error(base_, contest_.accounts[i], effects);
      take_odds(i);
      best = std::max(best, all[i].log_odds);
      report_progress(fmt::format("  {} with the mesh's error under it: log odds {:.1f}",
                                  all[i].candidate.label(), all[i].log_odds));
    }
    contest_.best = weigh(contest_.round, refitted_);
  }

  void report_progress(const std::string& line) const {
    if (options_.progress) options_.progress(line);
  }

  double heldout_gain(const ModelFit& a) const {
    return a.heldout.log_evidence - base_.account.heldout.log_evidence;
  }

  /// Log evidence over the base's, on all data.
  void take_odds(size_t i) {
    const ModelFit& a = contest_.accounts[i];
    RankedCandidate& r = contest_.round.candidates[i];
    r.heldout_gain = heldout_gain(a);
    r.log_odds = a.fit.log_evidence - base_.account.fit.log_evidence + r.heldout_gain +
                 prior_[scores_[i].candidate];
  }

  void refit_one(size_t i) {
    RankedCandidate& r = contest_.round.candidates[i];
    ModelFit& account = contest_.accounts[i];
    report_progress(fmt::format("  refitting {}, log odds {:.1f} by its score", r.candidate.label(),
                                r.log_odds));
    account = refit(base_.account, r.candidate, scores_[i], base_.evidence,
                    best_ ? best_->fit.value + far_behind : infinity);
    r.message = account.message;
    if (!account.fitted()) return report_progress(fmt::format("    given up: {}", r.message));
    r.refitted = true;
    const double gain = account.fit.log_evidence - base_.account.fit.log_evidence;
    r.log_odds = gain + prior_[scores_[i].candidate];
    if (gain < gained_ - far_behind) return;
    if (!fit_heldout_of(i)) {
      r.message = "does not reach the conditions held out: " + account.heldout.message;
      return report_progress("    " + r.message);
    }
    if (gain > gained_ || !best_) gained_ = std::max(gain, gained_), best_ = &account;
    refitted_.push_back(i);
    take_odds(i);
    report_progress(
        fmt::format("    log odds {:.1f} ({:+.1f} by conditions held out), chi2 {:.0f} of {:.0f}",
                    r.log_odds, r.heldout_gain, account.chi_square, account.dof));
  }

  bool fit_heldout_of(size_t i) {
    const ModelFit& base = base_.account;
    ModelFit& account = contest_.accounts[i];
    if (!base.heldout_set) return true;
    if (heldout_influences_.empty())
      heldout_influences_ = influences_of(*base.heldout_set, base.heldout);
    const Candidate& candidate = contest_.round.candidates[i].candidate;
    const auto start = with_candidate(candidate, account.fit.shared, *base.heldout_set,
                                      base.heldout, base_.evidence.heldout, heldout_influences_);
    with_heldout_fit(account, &start, base_.evidence);
    if (!reaches_all(account.heldout, base.heldout) ||
        (candidate.is_switch() && !improves(account.heldout, base.heldout)))
      with_heldout_fit(account, nullptr, base_.evidence);
    return reaches_all(account.heldout, base.heldout);
  }

  NullModel& base_;
  SelectionRound& contest_;
  const DiscoverOptions& options_;
  std::vector<Candidate> all_;
  std::vector<double> prior_;  // log odds of each before data
  std::vector<Score> scores_;  // best first, as in the round
  std::vector<size_t> refitted_;
  double gained_ = 0;               // by the best refit, of log evidence
  const ModelFit* best_ = nullptr;  // of these
  std::vector<Matrix> heldout_influences_;
};

}  // namespace

SelectionRound contest(NullModel& base, const std::vector<Matrix>& influences,
                       const Projection& projection, const std::vector<Candidate>& found,
                       const DiscoverOptions& options) {
  SelectionRound c;
  c.round.chi_square = base.account.chi_square, c.round.dof = base.account.dof;
  Refits refits(base, c, found, options);
  const auto started = std::chrono::steady_clock::now();
  refits.score(influences, projection);
  c.round.seconds_scoring =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  refits.refit_best();
  refits.decide(found);
  return c;
}

}  // namespace genio
