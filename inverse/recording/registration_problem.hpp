#pragma once
// The cost of a registration and its minimum near a start. Not for other rooms.

#include "inverse/recording/reach.hpp"
#include "inverse/recording/registration.hpp"

namespace genio {

/// A recording's palate trace and contours against lines of the model. A point v is (tilt,
/// logarithm of the scale, place of `centre` in the model); all lengths in metres.
struct RegistrationProblem {
  std::vector<Vec2> palate, trace;  ///< of the model, and of the recording (may be empty)
  std::vector<std::vector<Vec2>> contours;
  std::vector<std::vector<Vec2>> lines;  ///< of the tongue, one a contour
  double strain = 0;                     ///< of the lines: what their own shapes cost
  double line_sd = 0;                    ///< how far a contour lies from its line
  double weight = 0;                     ///< independent points of all contours
  bool free = false;                     ///< nothing is believed of the scale
  HeadMarks marks;                       ///< a bite plane is horizontal in the model
  Vec2 centre = Vec2::Zero();            ///< rotation and scale act about it

  Similarity transform(const std::vector<double>& v) const;
  /// Squares in units of their standard deviations; `gradient` is filled unless it is empty.
  double cost(const std::vector<double>& v, std::vector<double>& gradient) const;
};

/// Runs from `v` to the optimum near it and gives the cost there.
double minimise(const RegistrationProblem& problem, std::vector<double>& v);

/// The same with each contour's line bent to it along the reach, in turn with the registration.
double minimise_with_reach(RegistrationProblem& problem, const TongueReach& reach,
                           std::vector<double>& v);

/// Inverse of half the Hessian at the optimum: the posterior covariance in Laplace's approximation.
Eigen::Matrix4d covariance(const RegistrationProblem& problem, const std::vector<double>& v);

}  // namespace genio
