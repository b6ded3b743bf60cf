#pragma once
// Candidates refitted in full and weighed against each other and against nothing.

#include "discrepancy/candidates/score.hpp"
#include "discrepancy/contest/separation.hpp"
#include "discrepancy/errors/refinement.hpp"

namespace genio {

constexpr double far_behind = 30;  ///< units of log posterior behind the best

/// A fit under one account of the data: the model as it is, or with one candidate more.
struct ModelFit {
  ModelDescription description;       ///< with it, at vanishing strength
  SharedPrior shared;                 ///< its numbers and those of earlier effects
  std::shared_ptr<ConditionSet> set;  ///< of the fitted conditions
  JointFit fit;
  double chi_square = 0, dof = 0;  ///< of the residuals
  std::shared_ptr<ConditionSet> heldout_set;
  JointFit heldout;                        ///< conditions held out, its parameters as fitted
  std::shared_ptr<Refinement> refinement;  ///< under it; null: under the model as it was
  std::string message;                     ///< why it could not be fitted

  bool fitted() const { return fit.converged; }
};

/// What selection needs of the data beside the candidates.
struct DataErrors {
  const Observations& observations;
  Errors fitted, heldout;  ///< of the conditions to fit, and of those held out
};

/// The base account with one candidate more: its strengths shared by all conditions, from the
/// score's estimate on; a switch at its typical strength, with every condition inverted anew where
/// it squeezes the base's commands into a worse valley. It gives up once minus the log posterior
/// does not come below `hopeless`.
ModelFit refit(const ModelFit& base, const Candidate& candidate, const Score& score,
               const DataErrors& evidence, double give_up_above);

/// Fits the held-out conditions under an account, its shared parameters at their fitted values,
/// from `start` (null: inverted anew). Nothing where none are held out.
void with_heldout_fit(ModelFit& account, const std::vector<FittedCondition>* start,
                      const DataErrors& evidence);

/// True where it explains the data better than `other`, whatever the volumes of their posteriors.
bool improves(const JointFit& fit, const JointFit& other);

/// True where it has all conditions that `before` had: none was out of reach.
inline bool reaches_all(const JointFit& fit, const JointFit& before) {
  return fit.conditions.size() == before.conditions.size();
}

/// Sets chi_square and dof of its fit.
void with_residual_test(ModelFit& account, const Errors& errors);

/// Where shared parameters stand in a description: fitted values written into its effects.
ModelDescription with_fitted(ModelDescription description, const JointFit& fit);

/// A fitted account by itself.
PosedModel posed_model_of(const ModelFit& account);

/// Log probability of candidates before data: half for nothing, the rest in equal parts for every
/// effect, and of each for its places.
std::vector<double> log_prior(const std::vector<Candidate>& candidates);

}  // namespace genio
