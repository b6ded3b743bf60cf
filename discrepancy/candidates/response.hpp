#pragma once
// How a fit's own unknowns answer to a change of what it shares.

#include "discrepancy/candidates/score.hpp"
#include "discrepancy/conditions/joint_fit.hpp"

namespace genio {

/// Conditions whose commands moved, to first order and within their bounds, to where they fit best
/// once the residuals have changed by `change` (of all conditions, one after another).
std::vector<FittedCondition> response(const JointFit& fit, const Errors& errors,
                                      const Vector& change);

/// The same where a candidate comes in that was fitted to other conditions, with these estimates.
/// `influences`: of each condition, see influence().
std::vector<FittedCondition> with_candidate(const Candidate& candidate,
                                            const std::vector<SharedEstimate>& estimates,
                                            const ConditionSet& set, const JointFit& fit,
                                            const Errors& errors,
                                            const std::vector<Matrix>& influences);

/// The same where a candidate that was fitted along goes back to its absent value: where a fit
/// without it has to start that is to be compared with it.
std::vector<FittedCondition> without_candidate(const Candidate& candidate, const JointFit& fit,
                                               const Errors& errors);

}  // namespace genio
