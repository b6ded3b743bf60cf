#include "forward/algebra/stiffness.hpp"

#include <algorithm>

namespace genio {

BlockPattern::BlockPattern(const HexMesh& mesh, std::span<const std::pair<int, int>> extra) {
  const int n = int(mesh.nodes.size());
  std::vector<std::vector<int>> columns(n);
  const auto couple = [&](int a, int b) { columns[std::max(a, b)].push_back(std::min(a, b)); };
  for (int a = 0; a < n; ++a) couple(a, a);
  for (const auto& element : mesh.elements)
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j <= i; ++j) couple(element[i], element[j]);
  for (const auto& [a, b] : extra) couple(a, b);

  row_start_.assign(1, 0);
  for (auto& row : columns) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    column_.insert(column_.end(), row.begin(), row.end());
    row_start_.push_back(int(column_.size()));
  }
  element_slots_.resize(mesh.elements.size());
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j <= i; ++j) {
        const int a = mesh.elements[e][i], b = mesh.elements[e][j];
        element_slots_[e][i * (i + 1) / 2 + j] = a >= b ? slot(a, b) : ~slot(b, a);
      }
}

int BlockPattern::slot(int a, int b) const {
  const auto first = column_.begin() + row_start_[a], last = column_.begin() + row_start_[a + 1];
  const auto it = std::lower_bound(first, last, b);
  return it != last && *it == b ? int(it - column_.begin()) : -1;
}

void Stiffness::add(int a, int b, const Mat3& k) {
  double* v = a >= b ? block(pattern_->slot(a, b)) : block(pattern_->slot(b, a));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) v[3 * i + j] += a >= b ? k(i, j) : k(j, i);
}

void Stiffness::add(const NodeMatrix& matrix, double scale) {
  for (Eigen::Index b = 0; b < matrix.outerSize(); ++b)
    for (NodeMatrix::InnerIterator it(matrix, b); it; ++it)
      if (it.index() >= b) {
        double* v = block(pattern_->slot(int(it.index()), int(b)));
        for (int i = 0; i < 3; ++i) v[4 * i] += scale * it.value();
      }
}

void Stiffness::add(const Stiffness& other, double scale) {
  for (size_t i = 0; i < values_.size(); ++i) values_[i] += scale * other.values_[i];
}

Vector Stiffness::multiply(const Vector& x) const {
  using Block = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  Vector y = Vector::Zero(x.size());
  for (int a = 0; a < pattern_->nodes(); ++a) {
    const Vec3 xa = x.segment<3>(3 * a);
    Vec3 ya = Vec3::Zero();
    for (int s = pattern_->row_start(a); s < pattern_->row_start(a + 1); ++s) {
      const int b = pattern_->column(s);
      const Block k(block(s));
      ya.noalias() += k * x.segment<3>(3 * b);
      if (b != a) y.segment<3>(3 * b).noalias() += k.transpose() * xa;
    }
    y.segment<3>(3 * a) += ya;
  }
  return y;
}

Matrix Stiffness::multiply_columns(const Matrix& columns) const {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Block = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  const Rows x = columns;
  Rows y = Rows::Zero(x.rows(), x.cols());
  for (int a = 0; a < pattern_->nodes(); ++a)
    for (int s = pattern_->row_start(a); s < pattern_->row_start(a + 1); ++s) {
      const int b = pattern_->column(s);
      const Block k(block(s));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          y.row(3 * a + i) += k(i, j) * x.row(3 * b + j);
          if (b != a) y.row(3 * b + j) += k(i, j) * x.row(3 * a + i);
        }
    }
  return y;
}

}  // namespace genio
