#include "discrepancy/errors/errors.hpp"

#include "discrepancy/conditions/influence.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {
namespace {

/// What smooth distances are off by: from a curved surface they are longer.
Corrections smoothing(const ConditionSet& set, const JointFit& fit) {
  Corrections result;
  for (size_t k = 0; k < set.size(); ++k) {
    const FittedCondition& c = fit.conditions[k];
    const HeadPose pose = head_pose(c.unknowns, c.z);
    const auto residuals = [&](double smooth) {
      return Comparison(set.model(k), set.condition(k).target, smooth)(c.x, pose);
    };
    Residuals exact = residuals(0);
    Vector added = exact.values - residuals(surface_smoothing).values;
    result.push_back({std::move(added), std::move(exact)});
  }
  return result;
}

/// Minus the log posterior, but for constants.
double cost(const JointFit& f, const Errors& errors) {
  return f.value + errors.covariance.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

CorrectionsAtFit corrections_at(const ConditionSet& set, const JointFit& fit,
                                const std::shared_ptr<const Refinement>& refinement) {
  if (!refinement) return {smoothing(set, fit), nullptr};
  RefinedCorrections refined = refinement->corrections(set, fit);
  return {std::move(refined.corrections),
          std::make_shared<const Refinement>(std::move(refined.refinement))};
}

Errors errors_at(ConditionSet& set, const JointFit& fit, Corrections corrections,
                 const ErrorModel& error_model) {
  Errors e;
  e.corrections = std::move(corrections);
  e.matrix = residual_covariance(set, fit, influences_of(set, fit), e.corrections, error_model);
  e.covariance.compute(e.matrix);
  return e;
}

bool runs_away(const JointFit& next, const Errors& new_errors, const JointFit& last,
               const Errors& errors, double by) {
  return errors.covariance.rows() > 0 && cost(next, new_errors) > cost(last, errors) + by;
}

}  // namespace genio
