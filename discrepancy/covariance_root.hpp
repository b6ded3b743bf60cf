#pragma once
#include <functional>

#include "forward/types.hpp"

namespace genio {

/// L (n x rank) with L L^T = C but for what leaves no more than `least` of any variance: a Cholesky
/// factor of as many columns as that takes, each for the unknown that is known worst so far
/// (Harbrecht, Peters & Schneider 2012, Applied Numerical Mathematics 62, algorithm 1). Only these
/// columns of the positive semidefinite C(i, j) and its diagonal are asked for.
Matrix covariance_root(Eigen::Index n,
                       const std::function<double(Eigen::Index, Eigen::Index)>& covariance,
                       double least);

}  // namespace genio
