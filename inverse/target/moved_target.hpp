#pragma once
// A target's points under a head pose. Not for other rooms.

#include <cmath>

#include "inverse/target/head_pose.hpp"

namespace genio {

/// Moves points about `middle`, and says how what is measured of a point follows the pose. Holds
/// copies, since callers pass poses that they make on the spot.
class MovedTarget {
 public:
  MovedTarget(const HeadPose& pose, const Vec2& middle) : pose_(pose), middle_(middle) {
    turn_ << std::cos(pose.turn), -std::sin(pose.turn), std::sin(pose.turn), std::cos(pose.turn);
  }
  Vec2 operator()(const Vec2& q) const { return middle_ + pose_.shift + turn_ * (q - middle_); }
  Vec3 operator()(const Vec3& q) const {
    const Vec2 moved = (*this)(Vec2(q[0], q[2]));
    return {moved[0], q[1], moved[1]};
  }
  /// d moved point / d (shift x, shift z, turn).
  Eigen::Matrix<double, 2, 3> by_pose(const Vec2& moved) const {
    const Vec2 arm = moved - middle_ - pose_.shift;
    Eigen::Matrix<double, 2, 3> d;
    d << 1, 0, -arm[1], 0, 1, arm[0];
    return d;
  }
  /// d2 moved point / d turn2; the other second derivatives are 0.
  Vec2 by_turn_twice(const Vec2& moved) const { return middle_ + pose_.shift - moved; }

 private:
  HeadPose pose_;
  Vec2 middle_;
  Eigen::Matrix2d turn_;
};

/// How Student's t softens a weighted distance r: value s, ds/dr, and of the loss s^2 / 2 its first
/// and second derivative. Gaussian (dof 0): s = r.
struct SoftLoss {
  double value, slope, loss_slope, loss_curvature;
  SoftLoss(double r, double dof) : value(r), slope(1), loss_slope(r), loss_curvature(1) {
    if (dof <= 0) return;
    const double q = r * r / dof;
    value = std::copysign(std::sqrt(dof * std::log1p(q)), r);
    loss_slope = r / (1 + q), loss_curvature = (1 - q) / ((1 + q) * (1 + q));
    slope = std::abs(r) > 1e-6 ? loss_slope / value : 1;
  }
};

}  // namespace genio
