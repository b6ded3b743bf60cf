#pragma once
// One posterior of several optima.

#include "inverse/shape/infer.hpp"

namespace genio {

/// Another optimum and its weight.
struct WeighedOptimum {
  double weight;
  const Answer* answer;
};

/// Fills the estimates of `best` from its samples and those of the others, each by its weight.
/// Optima of less than a twentieth are left out. Answers without a posterior stay as they are.
void mix_optima(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                const std::vector<WeighedOptimum>& others, Answer& best);

}  // namespace genio
