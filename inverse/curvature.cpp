#include "inverse/curvature.hpp"

#include <algorithm>

namespace genio {
namespace {

constexpr double step = 1e-6;  // longest displacement of a node or a target point [m]
constexpr double arm = 0.03;   // of a target point about the middle [m]

}  // namespace

Matrix command_pulls(const Model& model, const std::vector<Command>& commands, const Positions& x,
                     const Parameters& p) {
  Matrix pulls = Matrix::Zero(x.size(), Eigen::Index(commands.size()));
  for (size_t c = 0; c < commands.size(); ++c) {
    const Matrix each = force_derivatives(model, x, p, commands[c].parameters);
    for (size_t i = 0; i < commands[c].shares.size(); ++i)
      pulls.col(Eigen::Index(c)) +=
          commands[c].shares[i] * commands[c].scale * each.col(Eigen::Index(i));
  }
  return pulls;
}

Vector misfit_gradient(const Residuals& residuals, const Vector& values, Eigen::Index size) {
  Vector g = Vector::Zero(size);
  for (size_t k = 0; k < residuals.gradient.size(); ++k)
    for (const auto& [node, slope] : residuals.gradient[k])
      g.segment<3>(3 * node) += values[Eigen::Index(k)] * slope;
  return g;
}

Matrix misfit_curvature(const Model& model, const Comparison& comparison,
                        const std::vector<Command>& commands, const Vector& z,
                        const Equilibrium& equilibrium, const Residuals& residuals,
                        const Matrix& positions, const Vector& adjoint, Workspace& ws) {
  const Positions& x = equilibrium.x;
  const Eigen::Index n = positions.cols();
  const Matrix by_pose = pose_derivative(commands);
  Matrix s = Matrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double size = std::max({positions.col(i).cwiseAbs().maxCoeff(),
                                  by_pose.col(i).head<2>().norm(), arm * std::abs(by_pose(2, i))});
    if (size == 0) continue;
    const double h = step / size;
    for (const double e : {h, -h}) {
      const Vector there = z + e * Vector::Unit(n, i);
      const Positions y = x + e * positions.col(i);
      const Parameters p = apply_commands(commands, there, equilibrium.parameters);
      const Residuals r = comparison(y, head_pose(commands, there));
      Vector slope = misfit_gradient(r, residuals.values, x.size());
      Vector row = by_pose.transpose() * (r.pose.transpose() * residuals.values);
      if (!positions.col(i).isZero(0)) {
        stiffness(model, y, p, ws.stiffness);
        slope -= ws.stiffness.multiply(adjoint);
        row += command_pulls(model, commands, y, p).transpose() * adjoint;
      }
      s.row(i) += (row + positions.transpose() * slope).transpose() / (2 * e);
    }
  }
  return 0.5 * (s + s.transpose());
}

}  // namespace genio
