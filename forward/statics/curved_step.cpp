#include "forward/statics/curved_step.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

namespace genio {
namespace {

using lanes::Lane;
using Lane33 = Lane[3][3];

constexpr int squarings = 4;
constexpr double straight_enough = 5e-3;  // of the velocity gradient

void multiply(const Lane33& a, const Lane33& b, Lane33& out) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}

/// Matrix exponential by scaling, the series up to the fourth power, and squaring.
void exponential(const Lane33& a, Lane33& e) {
  Lane33 x, term, next;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      x[i][j] = a[i][j] / double(1 << squarings);
      term[i][j] = x[i][j];
      e[i][j] = x[i][j] + (i == j ? 1.0 : 0.0);
    }
  for (int power = 2; power <= 4; ++power) {
    multiply(term, x, next);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) term[i][j] = next[i][j] / double(power), e[i][j] += term[i][j];
  }
  for (int s = 0; s < squarings; ++s) {
    multiply(e, e, next);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) e[i][j] = next[i][j];
  }
}

void invert(const Lane33& f, Lane33& inverse) {
  Lane33 c;
  lanes::cofactors(f, c);
  const Lane det = f[0][0] * c[0][0] + f[0][1] * c[0][1] + f[0][2] * c[0][2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse[j][i] = c[i][j] / det;
}

/// F and the velocity gradient grad(step) F^-1 of a batch at its Gauss points.
struct VelocityGradient {
  Lane33 f[8], rate[8];

  VelocityGradient(const ElementBatch& batch, const Positions& x, const Vector& step) {
    const auto position = gather(batch, x), moved = gather(batch, step);
    for (int q = 0; q < 8; ++q) {
      Lane33 g, inverse;
      gradient(batch, q, position, f[q]);
      gradient(batch, q, moved, g);
      invert(f[q], inverse);
      multiply(g, inverse, rate[q]);
    }
  }
};

}  // namespace

CurvedStep::CurvedStep(const HexMesh& mesh, const std::vector<Support>& supports)
    : batches_(element_batches(mesh)), free_(supports.size(), -1) {
  for (size_t a = 0; a < supports.size(); ++a)
    if (supports[a] == Support::free) free_[a] = unknowns_++;
  std::vector<Eigen::Triplet<double>> inner, outer;
  for (const ElementBatch& batch : batches_)
    for (int l = 0; l < batch.count; ++l)
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b) {
          double k = 0;
          for (int q = 0; q < 8; ++q)
            for (int j = 0; j < 3; ++j)
              k += batch.weight[q][l] * batch.gradient[q][a][j][l] * batch.gradient[q][b][j][l];
          const int na = batch.node[a][l], nb = batch.node[b][l];
          if (free_[na] < 0) continue;
          if (free_[nb] >= 0 && free_[nb] <= free_[na]) inner.emplace_back(free_[na], free_[nb], k);
          else if (free_[nb] >= 0) continue;
          else outer.emplace_back(free_[na], nb, k);
        }
  Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
  matrix.setFromTriplets(inner.begin(), inner.end());
  boundary_.resize(unknowns_, int(supports.size()));
  boundary_.setFromTriplets(outer.begin(), outer.end());
  if (unknowns_ == 0) return;
  std::vector<int> each(size_t(unknowns_ + 1));
  std::iota(each.begin(), each.end(), 0);
  poisson_ = std::make_unique<Cholesky>(matrix, each);
  poisson_->factorize(matrix);
}

double CurvedStep::size(const Positions& x, const Vector& step) const {
  double sum = 0, volume = 0;
  for (const ElementBatch& batch : batches_) {
    const VelocityGradient v(batch, x, step);
    for (int q = 0; q < 8; ++q) {
      Lane square = lanes::splat(0);
      for (const auto& row : v.rate[q])
        for (const Lane& r : row) square += r * r;
      for (int l = 0; l < batch.count; ++l)
        sum += batch.weight[q][l] * square[l], volume += batch.weight[q][l];
    }
  }
  return std::sqrt(sum / volume);
}

Positions CurvedStep::operator()(const Positions& x, const Vector& step) const {
  Positions y = x + step;
  double largest = 0;
  for (const ElementBatch& batch : batches_) {
    const VelocityGradient v(batch, x, step);
    for (const auto& rate : v.rate)
      for (int l = 0; l < batch.count; ++l)
        for (const auto& row : rate)
          for (const Lane& r : row) largest = std::max(largest, std::abs(r[l]));
  }
  if (!poisson_ || !(largest > straight_enough)) return y;
  Matrix right = Matrix::Zero(unknowns_, 3);
  for (const ElementBatch& batch : batches_) {
    const VelocityGradient v(batch, x, step);
    for (int q = 0; q < 8; ++q) {
      Lane33 e, target;
      exponential(v.rate[q], e);
      multiply(e, v.f[q], target);
      for (int a = 0; a < 8; ++a) {
        const auto& d = batch.gradient[q][a];
        for (int i = 0; i < 3; ++i) {
          const Lane pull =
              batch.weight[q] * (target[i][0] * d[0] + target[i][1] * d[1] + target[i][2] * d[2]);
          for (int l = 0; l < batch.count; ++l)
            if (const int u = free_[batch.node[a][l]]; u >= 0) right(u, i) += pull[l];
        }
      }
    }
  }
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> nodes(y.data(), 3, y.size() / 3);
  right -= boundary_ * nodes.transpose();
  const Matrix solved = poisson_->solve(right);
  for (size_t a = 0; a < free_.size(); ++a)
    if (free_[a] >= 0) y.segment<3>(Eigen::Index(3 * a)) = solved.row(free_[a]).transpose();
  return y;
}

}  // namespace genio
