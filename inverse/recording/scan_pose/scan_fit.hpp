#pragma once
// A rigid motion, a scale and a shape that lay a scan onto the model's surface, found together.
// Not for other rooms.

#include "forward/geometry/surfaces/closest_point.hpp"
#include "inverse/recording/scan_pose/scan_registration.hpp"

namespace genio {

/// Points of a scan against surfaces of the model; all lengths in metres. Rotation and scale act
/// about `centre`, and nobody's head is turned far from `level`.
struct ScanProblem {
  const SurfaceReach& reach;
  const SurfaceDistance* palate;  ///< of the model; null where the scan has no palate
  std::vector<Vec3> points, trace;
  double weight;  ///< how many independent points the scan counts as
  Vec3 centre = Vec3::Zero();
  Mat3 level = Mat3::Identity();
  bool free = false;  ///< nothing is believed of the scale
};

/// Unknowns: a rotation vector, the logarithm of the scale, the place of the centre.
constexpr int pose_size = 7;

struct ScanFit {
  double cost = 0;  ///< squares in units of their standard deviations
  ScanPose pose;
  Positions shape;  ///< of the model's tongue, bent to the scan [m]
  /// The covariance of the unknowns in Laplace's approximation, whatever the shape is.
  Eigen::Matrix<double, pose_size, pose_size> spread =
      Eigen::Matrix<double, pose_size, pose_size>::Zero();
};

/// Runs from `pose` to the optimum near it (iterated closest points with Levenberg and Marquardt's
/// damping; distances count along the surface's normal, Chen & Medioni 1992). Its cost never rises.
/// `bends`: the surface follows along its reach.
ScanFit fit_scan(const ScanProblem& problem, const ScanPose& pose, bool bends, int most_steps);

/// A rotation's vector [rad].
Vec3 rotation_vector(const Mat3& rotation);

}  // namespace genio
