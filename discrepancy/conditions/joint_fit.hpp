#pragma once
// All conditions at once: commands of each, and model parameters that they share.

#include <Eigen/Cholesky>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "discrepancy/conditions/condition_set.hpp"
#include "forward/base/parameter_name.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// How far about a measured point its distance from the surface is taken, see Comparison [m].
constexpr double surface_smoothing = 1.5e-3;

/// Parameters of the model that all conditions share, and what is believed of them; a head pose
/// where the data themselves are laid wrongly.
struct SharedPrior {
  std::map<ParameterName, ParameterPrior> parameters;
  std::optional<HeadPosePrior> head_pose;
  double log_weight = 0;  ///< of these beliefs, among those there are; counts as evidence
};

struct FittedCondition {
  std::vector<Unknown> unknowns;  ///< its unknowns: muscles, shared parameters, head pose
  std::vector<int> which;         ///< where each stands among the joint unknowns
  Vector z;
  Positions x;  ///< [m]
  Parameters parameters;
  Residuals residuals;  ///< in units of the noise
  Matrix jacobian;      ///< d residuals / dz
};

/// A shared parameter's estimate in its own unit.
struct SharedEstimate {
  ParameterName name;
  std::string unit;
  double value = 0, sd = 0, low = 0, high = 0;  ///< 90 % interval
  Unknown::Kind kind = Unknown::Kind::parameter;
  PoseAxis axis = PoseAxis::x;  ///< of a part of the head pose
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

/// What a condition's residuals would be by exact distances from the fine tongue.
struct Correction {
  Vector added;     ///< to the fit's residuals, in units of the noise
  Residuals exact;  ///< as they are there
};
/// Of each condition (empty: nothing is added).
using Corrections = std::vector<Correction>;

/// Residuals of one set of conditions: how they may be off although nothing is missing.
struct Errors {
  Corrections corrections;
  Matrix matrix;  ///< the covariance
  Eigen::LLT<Matrix> covariance;
};

/// Conditions, fitted before, that a fit starts from. They must outlive it.
using FitStart = std::optional<std::span<const FittedCondition>>;

struct FitOptions {
  FitStart start = {};  ///< none: each condition is first inverted by itself
  std::map<ParameterName, double> shared_start = {};  ///< of shared parameters, in their own unit
  std::map<ParameterName, double> fixed = {};         ///< shared parameters that stay as they are
  double precision = 0.5;  ///< of the log posterior: enough to compare models
  /// Gives up once minus the log posterior does not come below this.
  double give_up_above = std::numeric_limits<double>::infinity();
};

/// The unknowns that maximise the posterior under the given errors (null: independent noise), by
/// Ipopt from equilibrium to equilibrium (descend()).
JointFit fit(ConditionSet& set, const SharedPrior& shared, const Errors* errors,
             const FitOptions& options = {});

}  // namespace genio
