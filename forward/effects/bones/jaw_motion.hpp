#pragma once
#include "forward/base/types.hpp"

namespace genio {

/// The jaw's hinge and slide: X -> c + R(angle) (X - c) - slide e_x, a turn about the transverse
/// axis through the condyle c that lowers what lies in front of it, and a glide forwards.
struct JawMotion {
  Vec3 hinge = Vec3(0.14, 0, 0.135);  ///< c [m]
  double angle = 0;                   ///< [deg], opening
  double slide = 0;                   ///< [m], forwards

  Mat3 turn() const;
  Mat3 turn_by_angle() const;  ///< dR/dangle [1/deg]

  Vec3 operator()(const Vec3& rest) const;
  Vec3 by_angle(const Vec3& rest) const;  ///< [m/deg]
  /// Where a point that moves with the jaw lies at rest.
  Vec3 back(const Vec3& moved) const;
  Vec3 back_by_angle(const Vec3& moved) const;
  Vec3 back_by_slide() const;
};

}  // namespace genio
