#include "forward/statics/sensitivity.hpp"

#include "forward/model/at_anatomy.hpp"

namespace genio {

Matrix sensitivity(const Model& model, const Equilibrium& equilibrium,
                   std::span<const int> parameters, Workspace& ws) {
  Matrix result = sensitivity_to_forces(
      model, equilibrium,
      force_derivatives(model, equilibrium.x, equilibrium.parameters, parameters), ws);
  if (result.size() > 0) result += held_motion(model, parameters);
  return result;
}

Matrix sensitivity_to_forces(const Model& model, const Equilibrium& equilibrium, const Matrix& df,
                             Workspace& ws) {
  ws.check(model);
  stiffness(model, equilibrium.x, equilibrium.parameters, ws.stiffness);
  if (!ws.factorize(model, equilibrium.x, equilibrium.parameters)) return {};
  return expand_columns(model.dofs, ws.cholesky.solve(reduce_columns(model.dofs, df)));
}

Matrix expand_columns(const DofMap& dofs, const Matrix& unknowns) {
  Matrix result(dofs.size(), unknowns.cols());
  for (Eigen::Index c = 0; c < unknowns.cols(); ++c) result.col(c) = dofs.expand(unknowns.col(c));
  return result;
}

Matrix reduce_columns(const DofMap& dofs, const Matrix& nodal) {
  Matrix result(dofs.unknowns(), nodal.cols());
  for (Eigen::Index c = 0; c < nodal.cols(); ++c) result.col(c) = dofs.reduce(nodal.col(c));
  return result;
}

}  // namespace genio
