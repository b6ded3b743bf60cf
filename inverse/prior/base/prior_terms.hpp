#pragma once
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// A prior on given unknowns z: 1/2 |A z - b|^2 within bounds.
struct PriorTerms {
  Matrix rows;    ///< A
  Vector values;  ///< b
  Vector lower, upper;
  /// Standard deviation of an unknown's row of effort; 0: it has none.
  Vector effort;
  Vector slab;  ///< scale of the slab of what may rest, see acting.hpp; 0: it never does

  double value(const Vector& z) const { return 0.5 * (rows * z - values).squaredNorm(); }
  Vector gradient(const Vector& z) const { return rows.transpose() * (rows * z - values); }
  Matrix hessian() const { return rows.transpose() * rows; }
  bool fixed(Eigen::Index i) const { return lower[i] == upper[i]; }
  /// Those that are not fixed.
  std::vector<Eigen::Index> open() const;
};

}  // namespace genio
