#include "forward/half_factor.hpp"

#include <Eigen/Dense>

namespace genio {

void HalfFactor::clear(const int* permutation, int size) {
  panels_.clear(), rows_.clear(), values_.clear();
  permutation_.assign(permutation, permutation + size);
}

void HalfFactor::add_panel(const int* rows, int row_count, int columns, const double* values) {
  panels_.push_back({columns, row_count, rows_.size(), values_.size()});
  rows_.insert(rows_.end(), rows, rows + row_count);
  const size_t first = values_.size(), count = size_t(row_count) * size_t(columns);
  values_.resize(first + count);
  for (size_t i = 0; i < count; ++i) values_[first + i] = float(values[i]);
}

Vector HalfFactor::solve(const Vector& b) const {
  using Panels = Eigen::Map<const Eigen::MatrixXf>;
  Eigen::VectorXf x(b.size()), below;
  for (Eigen::Index i = 0; i < b.size(); ++i) x[i] = float(b[permutation_[size_t(i)]]);
  for (const Panel& p : panels_) {
    const Panels l(&values_[p.first_value], p.rows, p.columns);
    const int* rows = &rows_[p.first_row];
    auto own = x.segment(rows[0], p.columns);
    l.topRows(p.columns).triangularView<Eigen::Lower>().solveInPlace(own);
    below.noalias() = l.bottomRows(p.rows - p.columns) * own;
    for (int i = p.columns; i < p.rows; ++i) x[rows[i]] -= below[i - p.columns];
  }
  for (size_t k = panels_.size(); k-- > 0;) {
    const Panel& p = panels_[k];
    const Panels l(&values_[p.first_value], p.rows, p.columns);
    const int* rows = &rows_[p.first_row];
    below.resize(p.rows - p.columns);
    for (int i = p.columns; i < p.rows; ++i) below[i - p.columns] = x[rows[i]];
    auto own = x.segment(rows[0], p.columns);
    own.noalias() -= l.bottomRows(p.rows - p.columns).transpose() * below;
    l.topRows(p.columns).transpose().triangularView<Eigen::Upper>().solveInPlace(own);
  }
  Vector solution(b.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) solution[permutation_[size_t(i)]] = double(x[i]);
  return solution;
}

}  // namespace genio
