#pragma once
// Fits under errors that belong to the fitted shapes themselves.

#include "discrepancy/contest/model_fit.hpp"
#include "discrepancy/errors/errors.hpp"

namespace genio {

constexpr double rough_precision = 1,
                 fine_precision = 0.1;  ///< precision of first and last fits, of the log posterior

/// A fit, the errors it was made under, and the refinement that knows the mesh's error.
struct SettledFit {
  JointFit fit;
  std::shared_ptr<const Errors> errors;          ///< null: none yet
  std::shared_ptr<const Refinement> refinement;  ///< null: the mesh is taken to be exact
};

/// Throws InputError where the fit lacks a condition of the set.
void expect_all(const ConditionSet& set, const JointFit& fit);

/// Errors at the fit and the fit under them, in turn, until the mesh's error stays as it is: forces
/// that made up for the mesh go back once it is corrected, and its error with them. The errors it
/// came with stay, if any, where that runs away (runs_away()). Throws InputError where a fit lacks
/// a condition.
SettledFit settled(ConditionSet& set, const SharedPrior& shared, SettledFit start,
                   const ErrorModel& error_model);

/// The refinement of a fitted model, without what breaks its symmetry; it starts from the fine
/// shapes that `before` knows. `effects`: all that the model has beyond the given one.
std::shared_ptr<const Refinement> refinement_under(const ModelFit& model,
                                                   const std::vector<Candidate>& effects,
                                                   const Refinement& before);

/// The model fitted once more with the mesh's error under it, which it had not when it was
/// refitted: of an effect of the tissue the mesh misses a part, of a head pose none. As it was
/// where that does not succeed. `refinement`: see refinement_under().
ModelFit refit_with_mesh_error(const ModelFit& model, const DataErrors& errors,
                               std::shared_ptr<const Refinement> refinement);

}  // namespace genio
