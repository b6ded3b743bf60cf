#include "discrepancy/discover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "discrepancy/influence.hpp"
#include "discrepancy/refinement.hpp"
#include "inverse/posterior.hpp"

namespace genio {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double behind = 0.4;
constexpr double rough = 1, fine = 0.03;  // precision of fits, of the log posterior

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Residuals of one set of conditions with all that is believed of their errors.
struct Errors {
  Corrections corrections;
  Matrix matrix;  ///< the covariance
  Eigen::LLT<Matrix> covariance;
  std::vector<Matrix> influences;
};

std::vector<Matrix> influences_of(Study& study, const JointFit& fit) {
  std::vector<Matrix> result;
  for (size_t k = 0; k < study.size(); ++k) result.push_back(influence(study, fit, k));
  return result;
}

/// Errors at a fit; the mesh's own are found anew.
Errors errors_at(Study& study, const JointFit& fit, Refinement* refinement,
                 const ModelDoubt& doubt) {
  Errors e;
  if (refinement) e.corrections = refinement->corrections(study, fit);
  e.influences = influences_of(study, fit);
  e.matrix = residual_covariance(study, fit, e.influences, e.corrections, doubt);
  e.covariance.compute(e.matrix);
  return e;
}

Gap gap_of(const JointFit& fit, double noise) {
  Gap g;
  const Vector r = fit.residuals();
  if (r.size() == 0) return g;
  double square = 0;
  Eigen::Index at = 0;
  for (const auto& c : fit.conditions)
    for (const auto& row : c.residuals.rows) square += std::pow(r[at++] / row.scale, 2);
  g.rms = std::sqrt(square / double(r.size()));
  g.excess = std::sqrt(std::max(0.0, g.rms * g.rms - noise * noise));
  return g;
}

std::vector<NamedEffect> named(const JointFit& fit, const std::vector<Candidate>& found,
                               const std::vector<double>& confidence) {
  std::vector<NamedEffect> result;
  for (size_t i = 0; i < found.size(); ++i) {
    NamedEffect n{found[i].effect, found[i].where, {}, confidence[i]};
    for (const SharedEstimate& e : fit.shared) {
      if (e.name.substr(0, e.name.find('.')) != found[i].effect) continue;
      const std::string key = e.name.substr(e.name.find('.') + 1);
      const bool other = found[i].effect == "weak_muscle" && key != found[i].where;
      if (!other) n.parameters.push_back(e);
    }
    if (found[i].hypothesis && found[i].hypothesis->is_switch())
      for (const FreeNumber& s : found[i].strengths)
        n.parameters.push_back({found[i].effect + "." + s.name, s.info.unit,
                                s.info.absent + s.info.typical, 0, 0, s.info.upper, false});
    result.push_back(std::move(n));
  }
  return result;
}

/// The most likely candidates, at most two of one effect, that are worth a refit.
std::vector<size_t> worth_a_refit(const std::vector<Candidate>& all,
                                  const std::vector<Score>& scores,
                                  const std::vector<double>& prior, int most) {
  std::vector<size_t> order(scores.size()), result;
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto odds = [&](size_t i) { return scores[i].log_evidence + prior[scores[i].candidate]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return odds(a) > odds(b); });
  std::map<std::string, int> count;
  for (size_t i : order) {
    if (int(result.size()) >= most || !scores[i].visible) break;
    // A straight line underrates effects that grow faster, but not by everything.
    if (odds(i) < 0.2 * odds(order.front()) - 5 || scores[i].log_evidence <= 0) break;
    if (++count[all[scores[i].candidate].effect] <= 2) result.push_back(i);
  }
  return result;
}

double cosine(const Vector& a, const Vector& b) {
  return a.size() == b.size() && a.size() > 0 ? std::abs(a.dot(b)) : 0;
}

class Search {
 public:
  Search(const ModelDescription& d, const Observations& o, const DiscoverOptions& options)
      : observations_(o), options_(options), found_(d) {
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
    base_.study =
        std::make_shared<Study>(with_mobile_supports(base_.description), observations_, fitted);
    tell(fmt::format("{} conditions to fit, {} held out", fitted.size(), heldout.size()));
    base_.fit = fit(*base_.study, {}, nullptr, {}, nullptr, {}, rough);
    if (base_.fit.conditions.size() != fitted.size())
      throw InputError("the model does not reach the conditions: " + base_.fit.message);
    if (options_.correct_mesh)
      refinement_ = std::make_unique<Refinement>(base_.description, observations_);
    // Forces that made up for the mesh go back once it is corrected, and its error with them.
    fit_base(rough), fit_base();
    if (!heldout.empty()) {
      heldout_study_ = std::make_shared<Study>(base_.description, observations_, heldout);
      heldout_fit_ = fit(*heldout_study_, {}, nullptr, {}, nullptr, {}, rough);
      if (heldout_fit_.conditions.size() != heldout.size())
        throw InputError("the model does not reach the conditions held out: " +
                         heldout_fit_.message);
      for (int times = 0; times < 2; ++times) {
        heldout_errors_ =
            errors_at(*heldout_study_, heldout_fit_, refinement_.get(), options_.doubt);
        heldout_fit_ = fit(*heldout_study_, {}, &heldout_errors_.covariance,
                           heldout_errors_.corrections, &heldout_fit_);
      }
    }
    d_.first = base_.fit, d_.heldout_first = heldout_fit_;
    d_.before = gap_of(base_.fit, d_.noise), d_.heldout_before = gap_of(heldout_fit_, d_.noise);
    base_.heldout = heldout_fit_;
    tell(fmt::format("gap {:.2f} mm ({:.2f} mm held out), noise {:.2f} mm", 1e3 * d_.before.rms,
                     1e3 * d_.heldout_before.rms, 1e3 * d_.noise));
  }

  /// Errors at the base's fit, and the fit again under them.
  void fit_base(double precision = fine) {
    errors_ = errors_at(*base_.study, base_.fit, refinement_.get(), options_.doubt);
    base_.fit = fit(*base_.study, base_.shared, &errors_.covariance, errors_.corrections,
                    &base_.fit, {}, precision);
    const Projection projection(base_.fit, errors_.covariance);
    base_.chi_square = projection.chi_square(), base_.dof = projection.dof();
  }

  Evidence evidence() const {
    return {observations_,
            errors_.covariance,
            errors_.corrections,
            heldout_study_ ? &heldout_errors_.covariance : nullptr,
            heldout_errors_.corrections,
            heldout_study_ ? &heldout_fit_ : nullptr};
  }

  /// Scores, refits and weighs; false when nothing more is to be named.
  bool search_once() {
    const auto started = Clock::now();
    errors_.influences = influences_of(*base_.study, base_.fit);
    const Projection projection(base_.fit, errors_.covariance);
    const auto all = candidates(base_.description, observations_);
    const auto scores = score(all, *base_.study, base_.fit, errors_.influences, projection);
    Round round;
    round.seconds_scoring = since(started);
    if (d_.rounds.empty()) {
      d_.map_before = d_.map_after = localise(*base_.study, base_.fit, errors_.matrix);
      d_.hidden = hidden_force(*base_.study, errors_.influences, projection);
    }
    round.chi_square = base_.chi_square, round.dof = base_.dof;
    const auto prior = log_prior(all);
    std::vector<Account> accounts(scores.size());
    for (size_t i = 0; i < scores.size(); ++i)
      round.candidates.push_back({all[scores[i].candidate], scores[i], false,
                                  scores[i].log_evidence + prior[scores[i].candidate], 0, ""});
    std::vector<size_t> refitted;
    double gained = 0;  // by the best refit, of log evidence
    for (size_t i : worth_a_refit(all, scores, prior, options_.refits)) {
      Ranked& r = round.candidates[i];
      // What a straight line puts this far behind no refit brings to the front.
      if (scores[i].log_evidence < behind * gained) continue;
      tell(fmt::format("  refitting {}", r.candidate.label()));
      accounts[i] = refit(base_, r.candidate, scores[i], evidence());
      r.message = accounts[i].message;
      if (!accounts[i].fitted()) continue;
      accounts[i].heldout = fit_heldout(accounts[i], evidence()).fit;
      r.refitted = true;
      gained = std::max(gained, accounts[i].fit.log_evidence - base_.fit.log_evidence);
      refitted.push_back(i);
      r.log_odds = odds(accounts[i]) + prior[scores[i].candidate];
      tell(fmt::format("    log odds {:.1f}, chi2 {:.0f} of {:.0f}", r.log_odds,
                       accounts[i].chi_square, accounts[i].dof));
    }
    size_t best = weigh(round, refitted);
    if (!refitted.empty() && round.nothing < options_.nothing && follow(accounts[best])) {
      for (size_t i : refitted)
        round.candidates[i].log_odds = odds(accounts[i]) + prior[scores[i].candidate];
      best = weigh(round, refitted);
    }
    const bool go_on = !refitted.empty() && round.nothing < options_.nothing;
    if (go_on) accept(round, best, std::move(accounts[best]));
    d_.rounds.push_back(std::move(round));
    return go_on;
  }

  /// Log evidence of an account over the base's, on all data.
  double odds(const Account& a) const {
    return a.fit.log_evidence - base_.fit.log_evidence + a.heldout.log_evidence -
           base_.heldout.log_evidence;
  }

  /// Lets the base start where a better account ended: that may have found a valley of the forces
  /// that has nothing to do with what it adds. True where the base got better by it.
  bool follow(const Account& better) {
    const double before = base_.fit.log_evidence + base_.heldout.log_evidence;
    const JointFit again =
        fit(*base_.study, base_.shared, &errors_.covariance, errors_.corrections, &better.fit);
    if (again.converged && again.log_evidence > base_.fit.log_evidence) base_.fit = again;
    if (heldout_study_ && better.heldout.converged) {
      const JointFit h = fit(*heldout_study_, {}, &heldout_errors_.covariance,
                             heldout_errors_.corrections, &better.heldout);
      if (h.converged && h.log_evidence > base_.heldout.log_evidence)
        base_.heldout = heldout_fit_ = h;
    }
    const double gain = base_.fit.log_evidence + base_.heldout.log_evidence - before;
    if (gain > 0) tell(fmt::format("  the model as it is does better from there: {:+.1f}", gain));
    return gain > 0;
  }

  /// Probabilities of all accounts: refitted ones by their evidence, the others by their scores,
  /// which count less where a refit could tell. Returns the best refitted one.
  static size_t weigh(Round& round, const std::vector<size_t>& refitted) {
    const double log_nothing = std::log(0.5);
    double most = log_nothing;
    for (size_t i : refitted) most = std::max(most, round.candidates[i].log_odds);
    double sum = std::exp(log_nothing - most);
    for (size_t i : refitted) sum += std::exp(round.candidates[i].log_odds - most);
    round.nothing = std::exp(log_nothing - most) / sum;
    size_t best = 0;
    double highest = -1;
    for (size_t i : refitted) {
      Ranked& r = round.candidates[i];
      r.probability = std::exp(r.log_odds - most) / sum;
      if (r.probability > highest) highest = r.probability, best = i;
    }
    return best;
  }

  void accept(const Round& round, size_t best, Account account) {
    const Ranked& r = round.candidates[best];
    std::map<std::string, double> by_effect;
    for (const Ranked& other : round.candidates)
      by_effect[other.candidate.effect] += other.probability;
    effects_.push_back(r.candidate);
    confidence_.push_back(by_effect[r.candidate.effect]);
    for (const Ranked& other : round.candidates)
      if (other.refitted && other.candidate.effect != r.candidate.effect &&
          other.probability > 0.01)
        rivals_.push_back({other.candidate.effect, other.candidate.where, other.probability,
                           cosine(other.score.direction, r.score.direction)});
    tell(fmt::format("  {}: probability {:.3f}", r.candidate.label(), confidence_.back()));
    // The next round's unknown supports need their derivatives too.
    base_.description = account.description, base_.shared = account.shared;
    const JointFit before = account.fit;
    base_.study = std::make_shared<Study>(with_mobile_supports(base_.description), observations_,
                                          fitted_conditions(observations_));
    base_.fit = fit(*base_.study, base_.shared, &errors_.covariance, errors_.corrections, &before,
                    {}, rough);
    if (refinement_)
      refinement_ =
          std::make_unique<Refinement>(with_fitted(base_.description, base_.fit), *refinement_);
    fit_base();
    if (heldout_study_) {
      HeldoutFit h = fit_heldout(base_, evidence());
      if (h.fit.conditions.size() == heldout_fit_.conditions.size()) {
        heldout_study_ = h.study, heldout_fit_ = h.fit;
        heldout_errors_ =
            errors_at(*heldout_study_, heldout_fit_, refinement_.get(), options_.doubt);
        HeldoutFit again = fit_heldout(base_, evidence());
        heldout_fit_ = again.fit, heldout_study_ = again.study;
      }
      base_.heldout = heldout_fit_;
    }
  }

  void decide() {
    d_.last = base_.fit, d_.heldout_last = heldout_fit_;
    d_.rest = base_.study->model(0).rest;
    if (!effects_.empty()) d_.map_after = localise(*base_.study, base_.fit, errors_.matrix);
    d_.after = gap_of(base_.fit, d_.noise), d_.heldout_after = gap_of(heldout_fit_, d_.noise);
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
    d_.message = explanation();
    if (d_.finding == Finding::unknown || d_.finding == Finding::none) {
      // What comes nearest is told among the alternatives, but is no name.
      for (size_t i = 0; i < effects_.size(); ++i)
        d_.alternatives.insert(d_.alternatives.begin() + long(i),
                               {effects_[i].effect, effects_[i].where, confidence_[i], 1});
      d_.effects.clear();
      d_.model = found_;
      d_.map_after = d_.map_before;
      d_.last = d_.first, d_.heldout_last = d_.heldout_first;
      d_.after = d_.before, d_.heldout_after = d_.heldout_before;
    }
  }

  std::string explanation() const {
    switch (d_.finding) {
      case Finding::none:
        return fmt::format("what is left is within noise (p = {:.2g})", d_.fit_tail);
      case Finding::unknown:
        return fmt::format("a gap beyond noise (p = {:.1g}) that no candidate explains",
                           d_.fit_tail);
      case Finding::ambiguous:
        return "these data do not tell the candidates below apart";
      case Finding::named:
        return fmt::format("with it, what is left is within noise (p = {:.2g})", d_.fit_tail);
    }
    return "";
  }

  const Observations& observations_;
  const DiscoverOptions& options_;
  ModelDescription found_;  // as given
  Account base_;
  std::unique_ptr<Refinement> refinement_;
  Errors errors_, heldout_errors_;
  std::shared_ptr<Study> heldout_study_;
  JointFit heldout_fit_;
  std::vector<Candidate> effects_;
  std::vector<double> confidence_;
  std::vector<Rival> rivals_;
  Discovery d_;
};

}  // namespace

const char* to_string(Finding finding) {
  switch (finding) {
    case Finding::named:
      return "named";
    case Finding::ambiguous:
      return "ambiguous";
    case Finding::none:
      return "none";
    case Finding::unknown:
      return "unknown";
  }
  return "none";
}

Discovery discover(const ModelDescription& description, const Observations& observations,
                   const DiscoverOptions& options) {
  return Search(description, observations, options).run();
}

}  // namespace genio
