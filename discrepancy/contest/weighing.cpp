#include "discrepancy/contest/weighing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace genio {

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

size_t weigh(Round& round, const std::vector<size_t>& refitted) {
  const double log_nothing = std::log(0.5);
  double most = log_nothing;
  for (size_t i : refitted) most = std::max(most, round.candidates[i].log_odds);
  double sum = std::exp(log_nothing - most);
  for (size_t i : refitted) sum += std::exp(round.candidates[i].log_odds - most);
  round.nothing = std::exp(log_nothing - most) / sum;
  size_t best = 0;
  double highest = -1;
  for (size_t i : refitted) {
    RankedCandidate& r = round.candidates[i];
    r.probability = std::exp(r.log_odds - most) / sum;
    if (r.probability > highest) highest = r.probability, best = i;
  }
  return best;
}

void rank(Round& round) {
  std::stable_sort(round.candidates.begin(), round.candidates.end(),
                   [](const RankedCandidate& a, const RankedCandidate& b) {
                     return std::tie(a.probability, a.log_odds) >
                            std::tie(b.probability, b.log_odds);
                   });
}

}  // namespace genio
