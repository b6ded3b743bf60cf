#include "discrepancy/conditions/influence.hpp"

#include "forward/statics/sensitivity.hpp"

namespace genio {

Matrix influence(Study& study, const JointFit& fit, size_t k) {
  const FittedCondition& c = fit.conditions[k];
  const auto& gradient = c.residuals.gradient;
  Matrix right = Matrix::Zero(c.x.size(), Eigen::Index(gradient.size()));
  for (size_t r = 0; r < gradient.size(); ++r)
    for (const auto& [node, g] : gradient[r]) right.col(Eigen::Index(r)).segment<3>(3 * node) += g;
  Equilibrium e;
  e.status = SolveStatus::converged, e.x = c.x, e.parameters = c.parameters;
  return sensitivity_to_forces(study.model(k), e, right, study.workspace(k)).transpose();
}

std::vector<Matrix> influences_of(Study& study, const JointFit& fit) {
  std::vector<Matrix> result;
  for (size_t k = 0; k < study.size(); ++k) result.push_back(influence(study, fit, k));
  return result;
}

}  // namespace genio
