#pragma once
// The null model: the model as it is so far, which candidates are tested against.

#include "discrepancy/contest/model_fit.hpp"
#include "discrepancy/errors/error_model.hpp"

namespace genio {

/// The model so far, fitted under the errors it may have.
struct NullModel {
  ModelFit model;
  DataErrors errors;
  std::shared_ptr<const Refinement> refinement;  ///< null: the mesh is taken to be exact
};

/// The model as given, fitted to all conditions. `correct_mesh`: with the mesh's own error taken
/// off. Throws InputError where it does not reach the conditions. The observations must outlive it.
NullModel fitted_null_model(const ModelDescription& description, const Observations& observations,
                            const ErrorModel& error_model, bool correct_mesh);

/// The null model of the next round: with the effects of the model that won, fitted with the mesh's
/// error under it. `effects`: all that were added so far. Throws InputError where it does not reach
/// the conditions.
NullModel with_winner(const NullModel& null_model, const ModelFit& winner,
                      const std::vector<Candidate>& effects, const ErrorModel& error_model);

/// The null model fitted from where a better model ends once what it adds goes away: that may be a
/// better valley of the forces, which has nothing to do with what was added. As it was where it
/// gains no log evidence.
NullModel restarted(const NullModel& null_model, const ModelFit& better, const Candidate& added);

}  // namespace genio
