#include "forward/algebra/gmres.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <vector>

namespace genio {
namespace {

constexpr int restart = 10;

/// What is least in residual over the first `steps` vectors of each column's basis, and how much of
/// the residual is left.
struct LeastResiduals {
  Matrix weights;  ///< steps x columns
  Vector left;     ///< norms
};

LeastResiduals least_residuals(const std::vector<Matrix>& hessenberg, const Vector& norms,
                               Eigen::Index steps) {
  LeastResiduals result{Matrix::Zero(steps, norms.size()), Vector::Zero(norms.size())};
  for (Eigen::Index c = 0; c < norms.size(); ++c) {
    if (norms[c] == 0) continue;
    const Matrix h = hessenberg[size_t(c)].topLeftCorner(steps + 1, steps);
    const Vector right = norms[c] * Vector::Unit(steps + 1, 0);
    result.weights.col(c) = h.completeOrthogonalDecomposition().solve(right);
    result.left[c] = (right - h * result.weights.col(c)).norm();
  }
  return result;
}

}  // namespace

bool gmres(const std::function<Matrix(const Matrix&)>& apply, const Matrix& b, double accuracy,
           int most, Matrix& x) {
  const Vector enough =
      (accuracy * b.colwise().norm().transpose()).cwiseMax(std::numeric_limits<double>::min());
  for (int used = 0; used < most;) {
    const Matrix residual = b - apply(x);
    ++used;
    const Vector norms = residual.colwise().norm();
    if (!norms.allFinite()) return false;
    if ((norms.array() <= enough.array()).all()) return true;
    std::vector<Matrix> basis{residual};
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      if (norms[c] > 0) basis[0].col(c) /= norms[c];
    std::vector<Matrix> hessenberg(size_t(x.cols()), Matrix::Zero(restart + 1, restart));
    LeastResiduals least;
    for (Eigen::Index k = 0; k < restart && used < most; ++k) {
      Matrix next = apply(basis.back());
      ++used;
      for (int twice = 0; twice < 2; ++twice)  // rounding leaves one pass short of orthogonal
        for (Eigen::Index i = 0; i <= k; ++i) {
          const Vector along = basis[size_t(i)].cwiseProduct(next).colwise().sum();
          next -= basis[size_t(i)] * along.asDiagonal();
          for (Eigen::Index c = 0; c < x.cols(); ++c) hessenberg[size_t(c)](i, k) += along[c];
        }
      for (Eigen::Index c = 0; c < x.cols(); ++c) {
        const double length = next.col(c).norm();
        hessenberg[size_t(c)](k + 1, k) = length;
        if (length > 0) next.col(c) /= length;
      }
      basis.push_back(std::move(next));
      least = least_residuals(hessenberg, norms, k + 1);
      if ((least.left.array() <= enough.array()).all()) break;
    }
    for (Eigen::Index k = 0; k < least.weights.rows(); ++k)
      x += basis[size_t(k)] * least.weights.row(k).asDiagonal();
    if (least.left.size() > 0 && (least.left.array() <= enough.array()).all()) return true;
  }
  return false;
}

}  // namespace genio
