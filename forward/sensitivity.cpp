#include "forward/sensitivity.hpp"

namespace genio {

Matrix sensitivity(const Model& model, const Equilibrium& equilibrium,
                   std::span<const int> parameters, Workspace& ws) {
  return sensitivity_to_forces(
      model, equilibrium,
      force_derivatives(model, equilibrium.x, equilibrium.parameters, parameters), ws);
}

Matrix sensitivity_to_forces(const Model& model, const Equilibrium& equilibrium, const Matrix& df,
                             Workspace& ws) {
  stiffness(model, equilibrium.x, equilibrium.parameters, ws.stiffness);
  if (!ws.factorize(model, equilibrium.x, equilibrium.parameters)) return {};
  Matrix right(model.dofs.unknowns(), df.cols());
  for (Eigen::Index c = 0; c < df.cols(); ++c) right.col(c) = model.dofs.reduce(df.col(c));
  const Matrix solved = ws.cholesky.solve(right);
  Matrix result(df.rows(), df.cols());
  for (Eigen::Index c = 0; c < df.cols(); ++c) result.col(c) = model.dofs.expand(solved.col(c));
  return result;
}

}  // namespace genio
