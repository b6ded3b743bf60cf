#include "forward/effects/bones/jaw_motion.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace genio {
namespace {

constexpr double radian = std::numbers::pi / 180;
const Vec3 forwards(-1, 0, 0);

}  // namespace

Mat3 JawMotion::turn() const {
  const double c = std::cos(angle * radian), s = std::sin(angle * radian);
  Mat3 r;
  r << c, 0, -s, 0, 1, 0, s, 0, c;  // in front of the hinge (x < c_x) z falls
  return r;
}

Mat3 JawMotion::turn_by_angle() const {
  const double c = std::cos(angle * radian), s = std::sin(angle * radian);
  Mat3 r;
  r << -s, 0, -c, 0, 0, 0, c, 0, -s;
  return radian * r;
}

Vec3 JawMotion::operator()(const Vec3& rest) const {
  return hinge + turn() * (rest - hinge) + slide * forwards;
}

Vec3 JawMotion::by_angle(const Vec3& rest) const { return turn_by_angle() * (rest - hinge); }

Vec3 JawMotion::back(const Vec3& moved) const {
  return hinge + turn().transpose() * (moved - slide * forwards - hinge);
}

Vec3 JawMotion::back_by_angle(const Vec3& moved) const {
  return turn_by_angle().transpose() * (moved - slide * forwards - hinge);
}

Vec3 JawMotion::back_by_slide() const { return -turn().transpose() * forwards; }

}  // namespace genio
