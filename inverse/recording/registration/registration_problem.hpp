#pragma once
// The cost of a registration and its minimum near a start. Not for other rooms.

#include <functional>
#include <numbers>

#include "inverse/recording/registration/reach.hpp"
#include "inverse/recording/registration/registration.hpp"

namespace genio {

constexpr double palate_sd = 2e-3;      // of a trace about the model's palate [m]
constexpr size_t most_trace = 42;       // independent points of a palate trace
constexpr double contours_weight = 60;  // independent points of all contours beside a palate
constexpr double tilt_sd = 20 * std::numbers::pi / 180;

/// A recording's palate trace and contours against lines of the model. A point v is (tilt,
/// logarithm of the scale, place of `centre` in the model); all lengths in metres.
struct RegistrationProblem {
  std::vector<Vec2> palate, trace;  ///< of the model, and of the recording (may be empty)
  std::vector<std::vector<Vec2>> contours;
  std::vector<Vec2> rest;      ///< the tongue's line at rest
  double weight = 0;           ///< independent points of all contours
  double scale_sd = 0.06;      ///< of the logarithm
  bool free = false;           ///< nothing is believed of the scale
  HeadMarks marks;             ///< a bite plane is horizontal in the model
  Vec2 centre = Vec2::Zero();  ///< rotation and scale act about it

  std::function<void()> on_step = {};  ///< as of TongueReach

  void step() const {
    if (on_step) on_step();
  }
  Similarity transform(const std::vector<double>& v) const;
  /// With all contours about the line at rest, in squares of standard deviations; `gradient` is
  /// filled unless it is empty.
  double cost(const std::vector<double>& v, std::vector<double>& gradient) const;
};

/// Squares that are no misfit of palate or contours: of tilt and scale about what is believed, and
/// of points of the head about their places.
struct Beliefs {
  double cost = 0;
  Eigen::Vector4d slope = Eigen::Vector4d::Zero();      ///< half the gradient
  Eigen::Matrix4d curvature = Eigen::Matrix4d::Zero();  ///< half the Hessian of Gauss and Newton
};
Beliefs beliefs(const RegistrationProblem& problem, const std::vector<double>& v);

/// How a point that the registration moves to `at` turns with v, its middle at `middle`.
Eigen::Matrix<double, 2, 4> by_registration(const Vec2& at, const Vec2& middle);

/// Runs from `v` to the optimum of cost() near it and gives the cost there.
double minimise(const RegistrationProblem& problem, std::vector<double>& v);

}  // namespace genio
