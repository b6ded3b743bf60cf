#pragma once
// Which candidates to refit, and how likely the refitted ones are.

#include "discrepancy/contest/discovery.hpp"

namespace genio {

/// The most likely candidates, at most two of one effect, that are worth a refit: indices into
/// `scores`. `prior`: log probabilities of the candidates.
std::vector<size_t> worth_a_refit(const std::vector<Candidate>& all,
                                  const std::vector<Score>& scores,
                                  const std::vector<double>& prior, int most);

/// Fills the probabilities of nothing and of the refitted candidates (indices) from their log odds.
/// Returns the likeliest of these; 0 where there is none.
size_t weigh(Round& round, const std::vector<size_t>& refitted);

/// Puts the likeliest candidates first: by probability, those without one by their log odds.
void rank(Round& round);

}  // namespace genio
