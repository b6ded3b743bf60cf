#pragma once
// What Gauss-Newton leaves out of the misfit's second derivatives.

#include <Eigen/SparseCore>
#include <vector>

#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {

/// sum_k value_k d2 value_k, what Gauss-Newton leaves out of the second derivatives of the misfit,
/// over the 3 n nodal positions and then the pose (shift x, shift z, turn): entries of both halves
/// of a symmetric matrix, duplicates to be added. `residuals`: those at x and pose.
std::vector<Eigen::Triplet<double>> misfit_curvature(const Comparison& comparison,
                                                     const Positions& x, const HeadPose& pose,
                                                     const Residuals& residuals);

}  // namespace genio
