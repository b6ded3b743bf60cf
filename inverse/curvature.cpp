#include "inverse/curvature.hpp"

#include <algorithm>

namespace genio {
namespace {

constexpr double step = 1e-6;  // longest nodal displacement of a difference [m]

}  // namespace

Matrix command_pulls(const Model& model, const std::vector<Command>& commands, const Positions& x,
                     const Parameters& p) {
  Matrix pulls = Matrix::Zero(x.size(), Eigen::Index(commands.size()));
  for (size_t c = 0; c < commands.size(); ++c) {
    const Matrix each = force_derivatives(model, x, p, commands[c].parameters);
    for (size_t i = 0; i < commands[c].shares.size(); ++i)
      pulls.col(Eigen::Index(c)) +=
          commands[c].shares[i] * commands[c].max_force * each.col(Eigen::Index(i));
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
                        const std::vector<Command>& commands, const Equilibrium& equilibrium,
                        const Residuals& residuals, const Matrix& positions, const Vector& adjoint,
                        Workspace& ws) {
  const Positions& x = equilibrium.x;
  const Parameters& p = equilibrium.parameters;
  const Eigen::Index n = positions.cols();
  Matrix shapes(n, n), pulls(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double size = positions.col(i).cwiseAbs().maxCoeff();
    if (size == 0) {
      shapes.row(i).setZero(), pulls.row(i).setZero();
      continue;
    }
    const double h = step / size;
    Vector slope = Vector::Zero(x.size());
    Vector work = Vector::Zero(n);
    for (const double e : {h, -h}) {
      const Positions y = x + e * positions.col(i);
      stiffness(model, y, p, ws.stiffness);
      slope += (misfit_gradient(comparison(y), residuals.values, x.size()) -
                ws.stiffness.multiply(adjoint)) /
               (2 * e);
      work += command_pulls(model, commands, y, p).transpose() * adjoint / (2 * e);
    }
    shapes.row(i) = positions.transpose() * slope;
    pulls.row(i) = work;
  }
  const Matrix s = shapes + pulls + pulls.transpose();
  return 0.5 * (s + s.transpose());
}

}  // namespace genio
