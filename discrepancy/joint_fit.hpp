#pragma once
// All conditions at once: commands of each, and model parameters that they share.

#include <Eigen/Cholesky>
#include <map>
#include <optional>

#include "discrepancy/study.hpp"

namespace genio {

/// Parameters of the model that all conditions share, and what is believed of them; a head pose
/// where the data themselves are laid wrongly.
struct SharedPrior {
  std::map<std::string, Normal> parameters;
  std::optional<Prior::HeadPose> head_pose;
};

struct FittedCondition {
  std::vector<Command> commands;  ///< its unknowns: muscles, shared parameters, head pose
  std::vector<int> which;         ///< where each stands among the joint unknowns
  Vector z;
  Positions x;  ///< [m]
  Parameters parameters;
  Residuals residuals;  ///< in units of the noise
  Matrix jacobian;      ///< d residuals / dz
};

/// A shared parameter's estimate in its own unit.
struct SharedEstimate {
  std::string name, unit;
  double value = 0, sd = 0, low = 0, high = 0;  ///< 90 % interval
};

struct JointFit {
  bool converged = false;
  std::string message;
  std::vector<FittedCondition> conditions;
  Vector u, lower, upper;   ///< joint unknowns
  Matrix prior_rows;        ///< A of the prior 1/2 |A u - b|^2
  Vector prior_values;      ///< b
  int own = 0;              ///< unknowns that belong to one condition; the shared ones follow
  double value = 0;         ///< minus the log posterior, but for constants
  double log_evidence = 0;  ///< by Laplace's method about u
  std::vector<SharedEstimate> shared;
  int iterations = 0;

  Vector residuals() const;  ///< of all conditions, one after another
  Matrix jacobian() const;   ///< of them, by all unknowns
};

/// What is added to each condition's residuals for the mesh's own error, in units of the noise
/// (empty: nothing).
using Corrections = std::vector<Vector>;

/// The unknowns that maximise the posterior under residuals of the given covariance (its factor;
/// null: independent), by Ipopt from equilibrium to equilibrium (descend()). It starts where
/// `start` ended, shared parameters that `start` has not at `shared_start` or what is believed of
/// them; without, each condition is first inverted by itself. `precision`: of the log posterior.
JointFit fit(Study& study, const SharedPrior& shared, const Eigen::LLT<Matrix>* covariance,
             const Corrections& corrections, const JointFit* start = nullptr,
             const std::map<std::string, double>& shared_start = {}, double precision = 0.03);

}  // namespace genio
