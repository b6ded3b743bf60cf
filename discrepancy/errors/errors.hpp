#pragma once
// The errors of one set of conditions at a fit.

#include "discrepancy/errors/error_model.hpp"
#include "discrepancy/errors/refinement.hpp"

namespace genio {

/// Corrections at a fit, and the refinement that knows them.
struct CorrectionsAtFit {
  Corrections corrections;
  std::shared_ptr<const Refinement> refinement;
};

/// The mesh's own error at a fit. Without a refinement (null) the mesh is taken to be exact, and
/// nothing is corrected but what smooth distances are off by.
CorrectionsAtFit corrections_at(const ConditionSet& set, const JointFit& fit,
                                const std::shared_ptr<const Refinement>& refinement);

/// The errors at a fit with these corrections.
Errors errors_at(ConditionSet& set, const JointFit& fit, Corrections corrections,
                 const ErrorModel& error_model);

/// True where a fit under new errors does not go with them as the last did with its own: minus the
/// log posterior of fit and errors grew by more than `by`. Where a shape is about to snap, errors
/// of the first order are large, make the misfit along them look free, and are small again where a
/// fit then goes. Never true without last errors.
bool runs_away(const JointFit& next, const Errors& new_errors, const JointFit& last,
               const Errors& errors, double by);

}  // namespace genio
