#pragma once
#include "inverse/target/tongue_line.hpp"

namespace genio {

/// A rigid motion of the target in the midsagittal plane, about its middle: where head and sensors
/// moved against each other.
struct HeadPose {
  Vec2 shift = Vec2::Zero();  ///< (x, z) [m]
  double turn = 0;            ///< counter-clockwise with x back and z up [rad]
};

}  // namespace genio
