#pragma once
// GMRES for many right-hand sides of one operator.

#include <functional>

#include "forward/base/types.hpp"

namespace genio {

/// Solves A X = B for all columns at once, each by its own GMRES (Saad & Schultz 1986, SIAM J. Sci.
/// Stat. Comput. 7), restarted: `apply` gives A of all columns together, since that may cost no
/// more than A of one. `x` is the start and becomes the solution. True once every column's residual
/// is at most `accuracy` of its right-hand side; false after `most` applications.
bool gmres(const std::function<Matrix(const Matrix&)>& apply, const Matrix& b, double accuracy,
           int most, Matrix& x);

}  // namespace genio
