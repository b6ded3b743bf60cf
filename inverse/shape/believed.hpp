#pragma once
// Whether a fit needs more of what is estimated along than anybody believes. Not for other rooms.

#include "inverse/shape/infer.hpp"

namespace genio {

/// How far the best fit takes head pose and parameters from what was believed of them.
struct BeliefTest {
  double tail = 1;                 ///< of chi-square: how rarely they lie as far off or farther
  const Unknown* worst = nullptr;  ///< the farthest; null: nothing was believed
  double worst_sds = 0;            ///< how far, in standard deviations
};
BeliefTest test_beliefs(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                        const Vector& z);

/// Turns `explained` into `mismatch` where the beliefs fail their test, and says why: such a shape
/// is fitted by a head or a jaw that nobody has.
void doubt_unbelievable(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                        const Vector& z, Answer& answer);

}  // namespace genio
