#include "forward/algebra/half_factor.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace genio {
namespace {

using Some = Eigen::Map<const Eigen::VectorXf>;

int triangle(int n) { return n * (n + 1) / 2; }

}  // namespace

void HalfFactor::clear(const int* permutation, int size) {
  panels_.clear(), rows_.clear(), values_.clear();
  permutation_.assign(permutation, permutation + size);
}

void HalfFactor::add_panel(const int* rows, int row_count, int columns, const double* values) {
  panels_.push_back({columns, row_count, rows_.size(), values_.size()});
  rows_.insert(rows_.end(), rows, rows + row_count);
  const auto at = [&](int row, int column) {
    return float(values[size_t(column) * size_t(row_count) + size_t(row)]);
  };
  const int strips = (row_count - columns + strip - 1) / strip;
  values_.resize(values_.size() + size_t(triangle(columns) + strips * strip * columns));
  float* v = &values_[panels_.back().first_value];
  for (int j = 0; j < columns; ++j) {
    *v++ = 1 / at(j, j);
    for (int i = j + 1; i < columns; ++i) *v++ = at(i, j);
  }
  for (int first = columns; first < row_count; first += strip)
    for (int j = 0; j < columns; ++j, v += strip)
      for (int i = first; i < std::min(first + strip, row_count); ++i) v[i - first] = at(i, j);
}

void HalfFactor::down(const Panel& p, float* x) const {
  const int* rows = &rows_[p.first_row];
  const float* v = &values_[p.first_value];
  float* own = x + rows[0];
  for (int j = 0, below = p.columns - 1; j < p.columns; ++j, --below) {
    own[j] *= *v++;
    Eigen::Map<Eigen::VectorXf>(own + j + 1, below) -= own[j] * Some(v, below);
    v += below;
  }
  for (int first = p.columns; first < p.rows; first += strip) {
    Strip even = Strip::Zero(), odd = Strip::Zero();  // two sums, so that none waits for the other
    int j = 0;
    for (; j + 1 < p.columns; j += 2, v += 2 * strip) {
      even += own[j] * StripOf(v);
      odd += own[j + 1] * StripOf(v + strip);
    }
    if (j < p.columns) even += own[j] * StripOf(v), v += strip;
    even += odd;
    const int count = std::min(strip, p.rows - first);
    for (int i = 0; i < count; ++i) x[rows[first + i]] -= even[i];
  }
}

void HalfFactor::up(const Panel& p, float* x, std::vector<Strip>& sums) const {
  const int* rows = &rows_[p.first_row];
  const float* v = &values_[p.first_value] + triangle(p.columns);
  float* own = x + rows[0];
  std::fill_n(sums.begin(), p.columns, Strip::Zero());
  for (int first = p.columns; first < p.rows; first += strip) {
    Strip below = Strip::Zero();
    const int count = std::min(strip, p.rows - first);
    for (int i = 0; i < count; ++i) below[i] = x[rows[first + i]];
    for (int j = 0; j < p.columns; ++j, v += strip) sums[size_t(j)] += below * StripOf(v);
  }
  v = &values_[p.first_value] + triangle(p.columns);
  for (int j = p.columns - 1, below = 0; j >= 0; --j, ++below) {
    v -= below + 1;
    const float known = Some(v + 1, below).dot(Some(own + j + 1, below));
    own[j] = (own[j] - sums[size_t(j)].sum() - known) * v[0];
  }
}

Vector HalfFactor::solve(const Vector& b) const {
  int widest = 0;
  for (const Panel& p : panels_) widest = std::max(widest, p.columns);
  std::vector<Strip> sums(static_cast<size_t>(widest));
  Eigen::VectorXf x(b.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) x[i] = float(b[permutation_[size_t(i)]]);
  for (const Panel& p : panels_) down(p, x.data());
  for (size_t k = panels_.size(); k-- > 0;) up(panels_[k], x.data(), sums);
  Vector solution(b.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) solution[permutation_[size_t(i)]] = double(x[i]);
  return solution;
}

}  // namespace genio
