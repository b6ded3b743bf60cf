#pragma once
// One round: candidates scored, the best refitted in full, and weighed against each other and
// nothing.

#include "discrepancy/contest/null_model.hpp"

namespace genio {

struct SelectionRound {
  Round round;
  std::vector<ModelFit> accounts;  ///< of each candidate of the round; most are not fitted
  size_t best = 0;                 ///< the likeliest candidate
  bool won = false;                ///< it is to be added
};

/// `influences` and `projection`: of the base's fitted conditions; `found`: effects added before.
/// The base may move to a better valley of the forces that a candidate's refit found.
SelectionRound contest(NullModel& base, const std::vector<Matrix>& influences,
                       const Projection& projection, const std::vector<Candidate>& found,
                       const DiscoverOptions& options);

}  // namespace genio
