#include "inverse/search/multi_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/base/elapsed.hpp"
#include "inverse/posterior/posterior.hpp"
#include "inverse/search/full_space.hpp"
#include "inverse/search/global_starts.hpp"
#include "inverse/search/mixed_optima.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double least_weight = 0.01;  // of an alternative worth telling
constexpr double apart = 3;            // posterior standard deviations between distinct optima
constexpr int patience = 5;            // descents for a target that no answer explains
constexpr int warm_patience = 4;       // the same with a start of the caller's
constexpr int longest_patience = 16;   // where no two of them end alike
constexpr double far_off = 3;          // chi-square over its degrees of freedom

/// Draws of the prior within its bounds, a column each.
Matrix prior_draws(const PriorTerms& prior, int count) {
  Matrix result = prior.lower.replicate(1, count);  // of the fixed ones that is the value
  result(prior.open(), Eigen::all) = sample(density_of(prior), count);
  return result;
}

/// True where some unknown of `a` lies beyond the spread that either answer claims.
bool distinct(const Answer& a, const Answer& b) {
  for (size_t i = 0; i < a.muscles.size(); ++i) {
    const auto &p = a.muscles[i], &q = b.muscles[i];
    // What surely rests has no spread of its own.
    const double spread = std::max({p.sd, q.sd, 5e-3 * p.maximum});
    if (std::abs(p.best - q.best) > apart * spread) return true;
  }
  // The same forces may hold two shapes.
  return (a.shape - b.shape).cwiseAbs().maxCoeff() > 1e-3;
}

/// True where the likeliest optimum was found more than once; of one that is far off the target,
/// more than three times.
bool settled(const std::vector<Answer>& found) {
  if (found.empty()) return false;
  const Answer& best = *std::max_element(
      found.begin(), found.end(),
      [](const Answer& a, const Answer& b) { return a.log_evidence < b.log_evidence; });
  const auto times = std::count_if(found.begin(), found.end(),
                                   [&](const Answer& a) { return !distinct(a, best); });
  return times > (best.chi2_per_dof > far_off ? 3 : 1);
}

/// Where to start from when nothing better is known, in the order to try.
std::vector<Atlas::Entry> guesses(const Model& model, const Target& target, const Prior& prior,
                                  const std::vector<Unknown>& unknowns, const PriorTerms& terms,
                                  TongueState& tongue, bool bilateral, int count,
                                  const StopAtlas& stop) {
  std::vector<Atlas::Entry> starts;
  const Atlas& atlas = tongue.atlas.get(model, prior, bilateral, tongue.workspace, stop);
  const Comparison comparison(model, target);
  const auto near = nearest(atlas, comparison, unknowns, terms);
  // The nearest known shape first; then the valleys that its neighbours foretell and the other
  // shapes in turn.
  if (!near.empty()) starts.push_back(*near.front());
  auto foretold = valleys(atlas, comparison, unknowns, terms, count / 2);
  for (size_t k = 0; k < std::max(foretold.size(), near.size()); ++k) {
    if (k < foretold.size() && int(starts.size()) < count) starts.push_back(std::move(foretold[k]));
    if (k + 1 < near.size() && int(starts.size()) < count) starts.push_back(*near[k + 1]);
  }
  const int drawn = count - int(starts.size());
  const Matrix draws = prior_draws(terms, std::max(0, drawn));
  for (int k = 0; k < drawn; ++k) starts.push_back({draws.col(k), {}, {}});
  return starts;
}

/// The likeliest of `found`, the distinct others as its alternatives. Its estimates hold all.
Answer weighed(std::vector<Answer> found, const std::vector<Unknown>& unknowns,
               const PriorTerms& prior) {
  std::stable_sort(found.begin(), found.end(), [](const Answer& a, const Answer& b) {
    return a.log_evidence > b.log_evidence;
  });
  std::vector<Answer> kept;
  for (Answer& a : found)
    if (std::none_of(kept.begin(), kept.end(), [&](const Answer& k) { return !distinct(a, k); }))
      kept.push_back(std::move(a));
  double sum = 0;
  for (const Answer& a : kept) sum += std::exp(a.log_evidence - kept.front().log_evidence);
  Answer best = std::move(kept.front());
  best.weight = 1 / sum;
  std::vector<WeighedOptimum> others;
  for (size_t k = 1; k < kept.size(); ++k)
    if (const double w = std::exp(kept[k].log_evidence - best.log_evidence) / sum;
        w >= least_weight) {
      others.push_back({w, &kept[k]});
      best.alternatives.push_back({w, kept[k].muscles, kept[k].rms, kept[k].shape});
    }
  mix_optima(unknowns, prior, others, best);
  return best;
}

Answer from_starts(const Target& target, const Prior& prior, TongueState& tongue,
                   const InferOptions& options, const StartOptions& start_options) {
  const Model& model = *tongue.model;
  const bool until_explained = start_options.starts == 0;
  const bool given = options.start.size() > 0;
  const int most = until_explained ? longest_patience : start_options.starts;
  const int enough = given ? warm_patience : patience;
  const bool bilateral = options.bilateral.value_or(target.midsagittal());
  const auto unknowns = unknowns_of(model, prior, bilateral);
  const PriorTerms terms = prior_terms(prior, unknowns);
  std::vector<Atlas::Entry> starts;
  if (given)
    starts.push_back(
        {options.start, options.start_shape.value_or(Positions()), options.start_by_unknown});
  std::vector<Answer> found;
  Answer last;
  const Stopwatch watch;
  // To make the atlas takes long.
  const StopAtlas stop = [&] {
    return (options.deadline_s > 0 && watch.seconds() >= options.deadline_s) ||
           (options.cancelled && options.cancelled());
  };
  int iterations = 0, factorizations = 0, solves = 0;
  for (int k = 0; k < most; ++k) {
    if (size_t(k) == starts.size()) {  // not before they are needed: the nearest, then all others
      const bool first = k == int(given);
      auto more = guesses(model, target, prior, unknowns, terms, tongue, bilateral,
                          first ? 1 : most - int(given), stop);
      starts.insert(starts.end(), more.begin() + (first ? 0 : 1), more.end());
    }
    const Atlas::Entry& start = starts[size_t(k)];
    InferOptions here = options;
    here.start = start.unknowns;
    here.start_shape.reset();
    if (start.shape.size() > 0) here.start_shape = start.shape;
    here.start_by_unknown = start.by_unknown;
    here.rough_start = start.shape.size() == 0;
    if (options.deadline_s > 0 && (here.deadline_s = options.deadline_s - watch.seconds()) <= 0) {
      // As when the first start was all that there was time for.
      last.status = InferStatus::deadline;
      if (k == 0) last.message = "the deadline passed before the first step was done";
      break;
    }
    last = (options.full_space ? infer_full_space : infer)(model, target, prior, tongue.workspace,
                                                           here);
    iterations += last.iterations;
    factorizations += last.factorizations, solves += last.forward_solves;
    if (last.status == InferStatus::converged) {
      found.push_back(last);
      if (options.improved) options.improved(last);
    }
    if (last.status == InferStatus::cancelled || last.status == InferStatus::deadline) break;
    if (until_explained && last.verdict == Verdict::explained) break;
    // An optimum that was found once only may not be the best that there is.
    if (until_explained && k + 1 >= enough && (found.empty() || settled(found))) break;
  }
  const InferStatus ended = last.status;
  const bool cut = ended == InferStatus::deadline || ended == InferStatus::cancelled;
  const size_t whole = found.size();
  Answer best = found.empty() ? std::move(last) : weighed(std::move(found), unknowns, terms);
  if (cut && whole > 0) {
    // Its intervals are whole, but a likelier optimum may have been left unfound.
    best.status = ended;
    best.message = fmt::format(
        "{} after {} starts; {}",
        ended == InferStatus::deadline ? "the deadline passed" : "cancelled by the requester",
        whole, best.message);
  }
  best.wall_s = watch.seconds(), best.iterations = iterations;
  best.factorizations = factorizations, best.forward_solves = solves;
  return best;
}

}  // namespace

Answer infer_from_starts(const Model& model, const Target& target, const Prior& prior,
                         InferWorkspace& ws, const InferOptions& options,
                         const StartOptions& start_options) {
  ws.check(model);
  if (target.empty()) throw InputError("the target has no points");
  if (fits_half_tongue(target, prior, options)) {
    prior_terms(prior, unknowns_of(model, prior, true));  // errors speak of the whole tongue
    if (TongueState* half = ws.half(prior)) {
      const Mirror& mirror = ws.mirror();
      return whole_answer(mirror, from_starts(half_target(mirror, target), half_prior(prior), *half,
                                              half_options(mirror, options), start_options));
    }
  }
  return from_starts(target, prior, ws.whole(), options, start_options);
}

}  // namespace genio
