#include "discrepancy/conditions/influence.hpp"

#include "forward/statics/sensitivity.hpp"

namespace genio {

Matrix influence(ConditionSet& set, const JointFit& fit, size_t k) {
  const FittedCondition& c = fit.conditions[k];
  const auto& gradient = c.residuals.gradient;
  Matrix right = Matrix::Zero(c.x.size(), Eigen::Index(gradient.size()));
  for (size_t r = 0; r < gradient.size(); ++r)
    for (const auto& [node, g] : gradient[r]) right.col(Eigen::Index(r)).segment<3>(3 * node) += g;
  Equilibrium e;
  e.status = SolveStatus::converged, e.x = c.x, e.parameters = c.parameters;
  return sensitivity_to_forces(set.model(k), e, right, set.workspace(k)).transpose();
}

std::vector<Matrix> influences_of(ConditionSet& set, const JointFit& fit) {
  std::vector<Matrix> result;
  for (size_t k = 0; k < set.size(); ++k) result.push_back(influence(set, fit, k));
  return result;
}

}  // namespace genio
