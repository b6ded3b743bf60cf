#include "forward/effects/gravity.hpp"

#include <Eigen/Dense>
#include <numbers>

namespace genio {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// From the frame of an upright head to that of one tilted backwards by `pitch` [deg].
Mat3 tilt(double pitch) {
  return Eigen::AngleAxisd(-pitch * degree, Vec3::UnitY()).toRotationMatrix();
}

}  // namespace

Gravity::Gravity(const NodeMatrix& mass, const Vec3& acceleration, double pitch)
    : mass_(mass * Vector::Ones(mass.cols())) {
  const char* axis[] = {"x", "y", "z"};
  // People are measured upright or on their back, their heads tilted by no more than 15 degrees to
  // a side or 24 forwards; more is for pitch.
  const double typical[] = {9.81, 1, 9.81}, least[] = {-4, -2.5, -20}, most[] = {20, 2.5, 0};
  for (size_t i = 0; i < 3; ++i)
    info_[i] = {axis[i], "m/s^2",  acceleration[Eigen::Index(i)],
                -20,     20,       0,
                true,    false,    typical[i],
                false,   least[i], most[i]};
  info_[3] = {"pitch", "deg", pitch, -180, 180, 0};
}

double Gravity::energy(const Positions& x, EffectParameters p) const {
  const Vec3 g = tilt(p[3]) * Vec3(p[0], p[1], p[2]);
  double e = 0;
  for (Eigen::Index a = 0; a < mass_.size(); ++a) e -= mass_[a] * g.dot(node_position(x, int(a)));
  return e;
}

void Gravity::add_weight(const Vec3& g, Forces& f) const {
  for (Eigen::Index a = 0; a < mass_.size(); ++a) f.segment<3>(3 * a) += mass_[a] * g;
}

void Gravity::add_force(const Positions&, EffectParameters p, Forces& f) const {
  add_weight(tilt(p[3]) * Vec3(p[0], p[1], p[2]), f);
}

void Gravity::add_force_derivative(const Positions&, EffectParameters p, int k, Forces& df) const {
  const Mat3 turn = tilt(p[3]);
  if (k < 3) {
    add_weight(turn.col(k), df);
    return;
  }
  const Vec3 g = turn * Vec3(p[0], p[1], p[2]);
  add_weight(-degree * Vec3::UnitY().cross(g), df);
}

}  // namespace genio
