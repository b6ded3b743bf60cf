#pragma once
// Which candidates to refit, and how likely the refitted ones are.

#include "discrepancy/contest/discovery.hpp"

namespace genio {

/// Log probability of candidates before data: half for the null model, the rest in equal parts for
/// every effect, and of each for its places.
std::vector<double> log_prior(const std::vector<Candidate>& candidates);

/// The candidates as their scores have them, in the order of `scores`: nothing is refitted yet.
/// `prior`: log probabilities of `all`.
std::vector<RankedCandidate> as_scored(const std::vector<Candidate>& all,
                                       const std::vector<Score>& scores,
                                       const std::vector<double>& prior);

/// The most likely candidates, at most two of one effect, that are worth a refit: at most `most`
/// indices into `scored`, the likeliest first.
std::vector<size_t> worth_a_refit(const std::vector<RankedCandidate>& scored, int most);

/// True where a candidate's score [log evidence] is too far behind that of the contender that its
/// refit has put in front. Scores are held against scores: a straight line may promise a third of
/// what refits gain, to this candidate as to that one. `gained`: by that contender's refit.
bool promises_too_little(double score, double score_in_front, double gained);

/// How likely the null model and its rivals are.
struct Weights {
  double nothing = 1;                 ///< probability of the null model
  std::vector<double> probabilities;  ///< of the rivals
  size_t likeliest = 0;               ///< of the rivals; 0 where there is none
};

/// `log_odds`: of every rival over the null model, log prior probabilities (log_prior()) included.
Weights weigh(const std::vector<double>& log_odds);

/// The likeliest candidates first: by probability, those without one by their log odds.
std::vector<RankedCandidate> ranked(std::vector<RankedCandidate> candidates);

}  // namespace genio
