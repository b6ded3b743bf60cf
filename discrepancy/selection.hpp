#pragma once
// Candidates refitted in full and weighed against each other and against nothing.

#include "discrepancy/score.hpp"

namespace genio {

/// A fit under one account of the data: the model as it is, or with one candidate more.
struct Account {
  ModelDescription description;  ///< with it, at vanishing strength
  SharedPrior shared;            ///< its numbers and those of earlier effects
  std::shared_ptr<Study> study;  ///< of the fitted conditions
  JointFit fit;
  double chi_square = 0, dof = 0;  ///< of the residuals
  JointFit heldout;                ///< conditions held out, its parameters as fitted
  std::string message;             ///< why it could not be fitted

  bool fitted() const { return fit.converged; }
};

struct HeldoutFit {
  std::shared_ptr<Study> study;
  JointFit fit;
};

/// What selection needs of the data beside the candidates.
struct Evidence {
  const Observations& observations;
  const Eigen::LLT<Matrix>& covariance;  ///< of the fitted conditions' residuals
  const Corrections& corrections;
  const Eigen::LLT<Matrix>* heldout_covariance;  ///< null: none held out
  const Corrections& heldout_corrections;
  const JointFit* heldout_start;
};

/// The base account with one candidate more: its strengths shared by all conditions, from the
/// score's estimate on; a switch at its typical strength.
Account refit(const Account& base, const Candidate& candidate, const Score& score,
              const Evidence& evidence);

/// The held-out conditions under an account, its shared parameters at their fitted values.
HeldoutFit fit_heldout(const Account& account, const Evidence& evidence);

/// Where shared parameters stand in a description: fitted values written into its effects.
ModelDescription with_fitted(ModelDescription description, const JointFit& fit);

/// Log probability of candidates before data: half for nothing, the rest in equal parts for every
/// effect, and of each for its places.
std::vector<double> log_prior(const std::vector<Candidate>& candidates);

}  // namespace genio
