#pragma once
// A registration and the shapes of the tongue in each of its frames, found together. Not for other
// rooms.

#include "inverse/recording/registration/registration_problem.hpp"

namespace genio {

/// Where the recording lies in the model, with each contour's line bent to it along the reach.
struct BentFit {
  double cost = 0;                            ///< squares in units of their standard deviations
  std::vector<double> v;                      ///< tilt, logarithm of the scale, place of the middle
  std::vector<std::vector<Vec2>> lines = {};  ///< one a contour [m]
  /// The covariance of v in Laplace's approximation, whatever the shapes are.
  Eigen::Matrix4d spread = Eigen::Matrix4d::Zero();
};

/// Runs from `v` to the optimum near it of the misfit of trace and contours, the strain of the
/// bent lines and what is believed of tilt and scale (Levenberg and Marquardt; the shapes of the
/// contours are eliminated, since each touches one contour only). Its cost never rises.
BentFit fit_bent_lines(const RegistrationProblem& problem, const TongueReach& reach,
                       std::vector<double> v);

}  // namespace genio
