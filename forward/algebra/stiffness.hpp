#pragma once
// Symmetric stiffness as 3x3 node blocks on a fixed pattern, and its reduction to free unknowns.

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "forward/base/types.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// Which node pairs may couple: the lower triangle (row >= column), row by row, columns sorted.
/// Built once a model; shared by every Stiffness.
class BlockPattern {
 public:
  BlockPattern() = default;
  /// Couplings of all elements plus the given extra node pairs.
  BlockPattern(const HexMesh& mesh, std::span<const std::pair<int, int>> extra);

  int nodes() const { return int(row_start_.size()) - 1; }
  int blocks() const { return int(column_.size()); }
  int row_start(int a) const { return row_start_[a]; }
  int column(int slot) const { return column_[slot]; }
  /// Slot of the block (a, b) with a >= b; -1 where the pattern has none.
  int slot(int a, int b) const;
  /// Slots of the element's 36 blocks, pair (i, j) with i >= j at i (i + 1) / 2 + j. A slot is
  /// stored as ~slot where node i < node j, that is, where the block must be transposed.
  const std::array<int, 36>& element_slots(int e) const { return element_slots_[e]; }

 private:
  std::vector<int> row_start_, column_;
  std::vector<std::array<int, 36>> element_slots_;
};

/// Values on a BlockPattern [N/m]. Blocks are row-major.
class Stiffness {
 public:
  explicit Stiffness(std::shared_ptr<const BlockPattern> pattern)
      : pattern_(std::move(pattern)), values_(size_t(9) * pattern_->blocks(), 0.0) {}

  void set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }
  const BlockPattern& pattern() const { return *pattern_; }
  /// True where it was made on this very pattern.
  bool is_on(const std::shared_ptr<const BlockPattern>& pattern) const {
    return pattern_ == pattern;
  }
  double* block(int slot) { return &values_[size_t(9) * slot]; }
  const double* block(int slot) const { return &values_[size_t(9) * slot]; }
  /// Adds d2E/dx_a dx_b; call it once for each unordered pair, and once for a == b.
  void add(int a, int b, const Mat3& k);
  /// Adds scale times a matrix over nodes to each of x, y and z.
  void add(const NodeMatrix& matrix, double scale);
  /// Adds scale times another on the same pattern.
  void add(const Stiffness& other, double scale);
  /// y = K x over all 3 n unknowns.
  Vector multiply(const Vector& x) const;
  /// The same for every column, at once.
  Matrix multiply_columns(const Matrix& x) const;

 private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> values_;
};

}  // namespace genio
