#pragma once
// A model fitted to all conditions, those held out too.

#include <memory>

#include "discrepancy/candidates/score.hpp"
#include "discrepancy/contest/separation.hpp"
#include "discrepancy/errors/refinement.hpp"

namespace genio {

constexpr double far_behind = 30;  ///< units of log posterior behind the best

/// The null model, or the null model with one candidate more, fitted to the conditions.
struct ModelFit {
  ModelDescription description;       ///< candidates in it stand at vanishing strength
  SharedPrior shared;                 ///< of their strengths
  std::shared_ptr<ConditionSet> set;  ///< the fitted conditions
  JointFit fit;
  double chi_square = 0, dof = 0;                ///< of the residuals
  std::shared_ptr<ConditionSet> heldout_set;     ///< null: no conditions are held out
  JointFit heldout;                              ///< of these, shared parameters as fitted
  std::shared_ptr<const Refinement> refinement;  ///< under this model; null: the null model's
  std::string message;                           ///< why it could not be fitted

  bool fitted() const { return fit.converged; }
  /// Of all conditions.
  double log_evidence() const { return fit.log_evidence + heldout.log_evidence; }
};

/// The errors that the data of all conditions may have.
struct DataErrors {
  std::shared_ptr<const Errors> fitted;
  std::shared_ptr<const Errors> heldout;  ///< null: no conditions are held out
};

/// The same model with the chi-square of its residuals and their degrees of freedom.
ModelFit with_residual_test(ModelFit model, const Errors& errors);

/// The same model with the held-out conditions fitted, its shared parameters at their fitted
/// values, from `start` (none: inverted anew). As it was where no conditions are held out.
ModelFit with_heldout_fit(ModelFit model, const FitStart& start, const DataErrors& errors);

/// True where a fit explains the data better than `other`, whatever the volumes of the posteriors.
bool improves(const JointFit& fit, const JointFit& other);

/// True where a fit has all conditions that `before` had: none was out of reach.
inline bool reaches_all(const JointFit& fit, const JointFit& before) {
  return fit.conditions.size() == before.conditions.size();
}

/// The description with the fitted values of shared parameters written into its effects.
ModelDescription with_fitted(ModelDescription description, const JointFit& fit);

/// A fitted model by itself, with the head pose that its data need.
PosedModel posed_model_of(const ModelFit& model);

}  // namespace genio
