#include "discrepancy/errors/covariance_root.hpp"

#include <cmath>

namespace genio {

Matrix covariance_root(Eigen::Index n, const Covariance& covariance, double part) {
  constexpr Eigen::Index more = 64;  // columns at a time
  Vector left(n);                    // of each variance
  for (Eigen::Index i = 0; i < n; ++i) left[i] = covariance(i, i);
  const double least = part * left.maxCoeff();
  Matrix root(n, 0);
  Eigen::Index rank = 0;
  for (Eigen::Index worst; rank < n && left.maxCoeff(&worst) > least; ++rank) {
    if (rank == root.cols()) root.conservativeResize(Eigen::NoChange, rank + more);
    auto column = root.col(rank);
    for (Eigen::Index i = 0; i < n; ++i) column[i] = covariance(i, worst);
    column -= root.leftCols(rank) * root.row(worst).head(rank).transpose();
    column /= std::sqrt(left[worst]);
    left -= column.cwiseAbs2();
    left[worst] = 0;
  }
  return root.leftCols(rank);
}

}  // namespace genio
