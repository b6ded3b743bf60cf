#include "discrepancy/contest/weighing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace genio {
namespace {

constexpr int most_places = 2;  // of one effect that are refitted in a round
// A straight line underrates effects that grow faster, but not by everything: log odds, as a part
// of the best ones and beyond that, below which no candidate is refitted.
constexpr double least_part = 0.2, least_below = 5;
constexpr double behind = 0.4;  // of the score in front, which a refit made good

}  // namespace

std::vector<double> log_prior(const std::vector<Candidate>& candidates) {
  std::map<std::string, int> places;
  for (const Candidate& c : candidates) ++places[c.effect];
  std::vector<double> result;
  for (const Candidate& c : candidates)
    result.push_back(-std::log(2.0 * double(places.size()) * places[c.effect]));
  return result;
}

std::vector<RankedCandidate> as_scored(const std::vector<Candidate>& all,
                                       const std::vector<Score>& scores,
                                       const std::vector<double>& prior) {
  std::vector<RankedCandidate> result;
  for (const Score& s : scores)
    result.push_back({.candidate = all[s.candidate],
                      .score = s,
                      .log_prior = prior[s.candidate],
                      .log_odds = s.log_evidence + prior[s.candidate]});
  return result;
}

std::vector<size_t> worth_a_refit(const std::vector<RankedCandidate>& scored, int most) {
  std::vector<size_t> order(scored.size()), result;
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return scored[a].log_odds > scored[b].log_odds; });
  std::map<std::string, int> count;
  for (size_t i : order) {
    const RankedCandidate& r = scored[i];
    if (int(result.size()) >= most || !r.score.visible) break;
    const double least = least_part * scored[order.front()].log_odds - least_below;
    if (r.log_odds < least || r.score.log_evidence <= 0) break;
    if (++count[r.candidate.effect] <= most_places) result.push_back(i);
  }
  return result;
}

bool promises_too_little(double score, double score_in_front, double gained) {
  return score < behind * std::min(score_in_front, gained);
}

Weights weigh(const std::vector<double>& log_odds) {
  const double log_nothing = std::log(0.5);
  double most = log_nothing;
  for (double odds : log_odds) most = std::max(most, odds);
  double sum = std::exp(log_nothing - most);
  for (double odds : log_odds) sum += std::exp(odds - most);
  Weights w;
  w.nothing = std::exp(log_nothing - most) / sum;
  double highest = -1;
  for (size_t i = 0; i < log_odds.size(); ++i) {
    w.probabilities.push_back(std::exp(log_odds[i] - most) / sum);
    if (w.probabilities[i] > highest) highest = w.probabilities[i], w.likeliest = i;
  }
  return w;
}

std::vector<RankedCandidate> ranked(std::vector<RankedCandidate> candidates) {
  std::stable_sort(
      candidates.begin(), candidates.end(), [](const RankedCandidate& a, const RankedCandidate& b) {
        return std::tie(a.probability, a.log_odds) > std::tie(b.probability, b.log_odds);
      });
  return candidates;
}

}  // namespace genio
