#pragma once
// A supernodal Cholesky factor copied to single precision: half the memory to read in a solve.

#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// L of P K P^T = L L^T by supernodes: dense panels of columns that share their rows.
class HalfFactor {
 public:
  /// One panel: rows[0 .. columns) are its own columns, the others lie below. `values` is
  /// column-major with rows.size() entries a column; its upper triangle is not read.
  void add_panel(const int* rows, int row_count, int columns, const double* values);
  void clear(const int* permutation, int size);
  bool empty() const { return panels_.empty(); }

  /// K^-1 b.
  Vector solve(const Vector& b) const;

 private:
  static constexpr int strip = 8;  ///< rows that are stored, and read, together
  using Strip = Eigen::Array<float, strip, 1>;
  using StripOf = Eigen::Map<const Strip>;
  /// Values: of the own columns the lower triangle by columns, the inverse of its diagonal in it;
  /// of the rows below one strip after the other, each by columns, the last filled up with zeros.
  /// Memory sets the pace, and is read from one end to the other.
  struct Panel {
    int columns, rows;
    size_t first_row, first_value;
  };
  void down(const Panel& p, float* x) const;
  void up(const Panel& p, float* x, std::vector<Strip>& sums) const;

  std::vector<Panel> panels_;
  std::vector<int> rows_, permutation_;
  std::vector<float> values_;
};

}  // namespace genio
