#include "forward/algebra/mixed_solver.hpp"

#include <Eigen/Jacobi>
#include <algorithm>
#include <cmath>

namespace genio {
namespace {

/// Forces of element pressures over the unknowns.
Vector forces(const VolumeGradients& gradients, const Vector& pressure, const DofMap& dofs) {
  Vector f = Vector::Zero(dofs.size());
  gradients.add_times(pressure, f);
  return dofs.reduce(f);
}

}  // namespace

void MixedSolver::remember(Bulk bulk, const Vector& diagonal, const DofMap& dofs) {
  stale_ = std::move(bulk);
  iterations_ = 0;
  last_ = {};
  Vector rest =
      diagonal - dofs.reduce(stale_.gradients.weighted_diagonal(stale_.stiffness, dofs.size()));
  const auto middle = rest.begin() + rest.size() / 2;
  std::nth_element(rest.begin(), middle, rest.end());
  stiffness_ = std::max(*middle, 1e-6 * diagonal.mean());
}

Vector MixedSolver::condensed(const MixedVector& right, const DofMap& dofs) const {
  return right.u + forces(stale_.gradients, stale_.stiffness.cwiseProduct(right.pressure), dofs);
}

MixedVector MixedSolver::with_pressure(Vector d, const MixedVector& right,
                                       const DofMap& dofs) const {
  const Vector rates = stale_.gradients.rates(dofs.expand(d));
  return {std::move(d), stale_.stiffness.cwiseProduct(rates - right.pressure)};
}

MixedVector MixedSolver::step(const Cholesky& factor, const MixedVector& right,
                              const DofMap& dofs) const {
  return with_pressure(factor.solve(condensed(right, dofs)), right, dofs);
}

const Vector& MixedSolver::displacement(const Cholesky& factor, Vector force) {
  if (force.size() != last_.force.size() || force != last_.force)
    last_.displacement = factor.precondition(force), last_.force = std::move(force);
  return last_.displacement;
}

double MixedSolver::norm(const Cholesky& factor, const MixedVector& right, const DofMap& dofs) {
  const Vector& d = displacement(factor, condensed(right, dofs));
  return last_.force.dot(d);
}

bool MixedSolver::solve(const Cholesky& factor, const DofMap& dofs, const Product& k,
                        const Bulk& now, const MixedVector& right, double accuracy, int patience,
                        MixedVector& step) {
  if (stale_.gradients.empty() || !factor.valid() || !(now.stiffness.minCoeff() > 0)) return false;
  const Eigen::Index n = right.u.size(), elements = now.stiffness.size();
  // Displacements and pressures of about the same energy, so that errors of both count.
  Vector unit(n + elements);
  unit << Vector::Constant(n, 1 / std::sqrt(stiffness_)), stale_.stiffness.cwiseSqrt();
  const Vector& c = now.stiffness;
  const auto scaled_step = [&](const Vector& u, const MixedVector& r) -> Vector {
    const MixedVector z = with_pressure(u, r, dofs);
    Vector v(n + elements);
    v << z.u, z.pressure;
    return v.cwiseQuotient(unit);
  };
  const auto times = [&](const Vector& v) -> MixedVector {
    const Vector d = v.head(n), q = v.tail(elements), rates = now.gradients.rates(dofs.expand(d));
    return {k(d) + forces(now.gradients, q - c.cwiseProduct(rates), dofs),
            rates - q.cwiseQuotient(c)};
  };

  Matrix basis(n + elements, patience + 1), h = Matrix::Zero(patience + 1, patience);
  std::vector<Eigen::JacobiRotation<double>> rotations;
  Vector g = Vector::Zero(patience + 1);
  basis.col(0) = scaled_step(displacement(factor, condensed(right, dofs)), right);
  const double whole = g[0] = basis.col(0).norm();
  basis.col(0) /= whole;
  for (int j = 0; j < patience; ++j) {
    iterations_ = j + 1;
    auto w = basis.col(j + 1);
    const MixedVector image = times(basis.col(j).cwiseProduct(unit));
    w = scaled_step(factor.precondition(condensed(image, dofs)), image);
    h.col(j).head(j + 1) = basis.leftCols(j + 1).transpose() * w;
    w -= basis.leftCols(j + 1) * h.col(j).head(j + 1);
    h(j + 1, j) = w.norm();
    if (!std::isfinite(h(j + 1, j))) return false;
    w /= std::max(h(j + 1, j), 1e-300);
    for (int i = 0; i < j; ++i) h.col(j).applyOnTheLeft(i, i + 1, rotations[size_t(i)].adjoint());
    rotations.emplace_back().makeGivens(h(j, j), h(j + 1, j));
    h.col(j).applyOnTheLeft(j, j + 1, rotations.back().adjoint());
    g.applyOnTheLeft(j, j + 1, rotations.back().adjoint());
    if (std::abs(g[j + 1]) > accuracy * whole) continue;
    const Vector y =
        h.topLeftCorner(j + 1, j + 1).triangularView<Eigen::Upper>().solve(g.head(j + 1));
    const Vector z = (basis.leftCols(j + 1) * y).cwiseProduct(unit);
    step = {z.head(n), z.tail(elements)};
    return true;
  }
  return false;
}

}  // namespace genio
