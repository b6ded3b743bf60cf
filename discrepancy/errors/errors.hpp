#pragma once
// The errors of one set of conditions at a fit.

#include "discrepancy/errors/error_model.hpp"
#include "discrepancy/errors/refinement.hpp"

namespace genio {

/// Errors at a fit; the mesh's own are found anew (null: none but what smooth distances are off
/// by).
Errors errors_at(ConditionSet& set, const JointFit& fit, Refinement* refinement,
                 const ErrorModel& error_model);

/// True where a fit under new errors does not go with them as the last did with its own: minus the
/// log posterior of fit and errors grew by more than `by`. Where a shape is about to snap, errors
/// of the first order are large, make the misfit along them look free, and are small again where a
/// fit then goes. Never true without last errors.
bool runs_away(const JointFit& next, const Errors& new_errors, const JointFit& last,
               const Errors& errors, double by);

}  // namespace genio
