#pragma once
// The account that candidates are measured against: the model as it is so far.

#include "discrepancy/contest/discover.hpp"
#include "discrepancy/contest/model_fit.hpp"

namespace genio {

/// The model so far, fitted with the errors it may have.
struct NullModel {
  ModelFit account;
  DataErrors evidence;
  std::shared_ptr<Refinement> refinement;  ///< null: the mesh is taken to be exact
};

/// The model as given, fitted to all conditions. Throws InputError where it does not reach them.
NullModel fitted_null_model(const ModelDescription& description, const Observations& observations,
                            const DiscoverOptions& options);

/// The base with the effects of an account that won: fitted with the mesh's error under it.
/// `effects`: all that were added so far. Throws InputError where it does not reach the conditions.
void adopted(NullModel& base, const ModelFit& winner, const std::vector<Candidate>& effects,
             const DiscoverOptions& options);

/// Fits an account once more with the mesh's error under it, which it had not when it was refitted:
/// of an effect of the tissue the mesh misses a part, of a head pose none. Stays as it is where
/// that does not succeed.
void with_mesh_error(const NullModel& base, ModelFit& account,
                     const std::vector<Candidate>& effects);

/// Lets the base start where a better account ends once what it adds goes away: it may have found a
/// valley of the forces that has nothing to do with that. Returns the log evidence gained by it.
double restarted(NullModel& base, const ModelFit& better, const Candidate& added);

}  // namespace genio
