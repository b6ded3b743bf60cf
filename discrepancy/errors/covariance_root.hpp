#pragma once
#include <functional>

#include "forward/base/types.hpp"

namespace genio {

/// Of unknowns i and j.
using Covariance = std::function<double(Eigen::Index, Eigen::Index)>;

/// L (n x rank) with L L^T = C but for what leaves no more of any variance than `part` of the
/// largest one: a Cholesky factor of as many columns as that takes, each for the unknown that is
/// known worst so far (Harbrecht, Peters & Schneider 2012, Applied Numerical Mathematics 62,
/// algorithm 1). Only these columns of the positive semidefinite C and its diagonal are asked for.
Matrix covariance_root(Eigen::Index n, const Covariance& covariance, double part);

}  // namespace genio
