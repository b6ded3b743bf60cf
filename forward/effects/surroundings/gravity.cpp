#include "forward/effects/surroundings/gravity.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
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
  // The box about what is plausible; more is for pitch.
  const double typical[] = {9.81, 1, 9.81}, least[] = {-4, -2.5, -20}, most[] = {20, 2.5, 0};
  for (size_t i = 0; i < 3; ++i)
    info_[i] = {axis[i], "m/s^2",  acceleration[Eigen::Index(i)],
                -20,     20,       0,
                true,    false,    typical[i],
                false,   least[i], most[i]};
  info_[3] = {"pitch", "deg", pitch, -180, 180, 0};
}

std::string Gravity::implausible(EffectParameters p) const {
  // People are measured upright or on their back, heads bowed by 24 degrees, thrown back by 15 more
  // or tilted to a side by 15 at most. Data are not sure of a direction: give 1 m/s^2 way.
  constexpr double most_bowed = -24, most_back = 105, most_aside = 15, way = 1;
  const auto beyond = [](double size, double angle, double limit) {
    return size * std::sin(std::clamp(angle - limit, 0.0, 90.0) * degree);
  };
  const double in_plane = std::hypot(p[0], p[2]), size = std::hypot(in_plane, p[1]);
  const double back = std::atan2(p[0], -p[2]) / degree;
  const double aside = std::atan2(std::abs(p[1]), in_plane) / degree;
  const bool turned =
      std::max(beyond(in_plane, back, most_back), beyond(in_plane, -back, -most_bowed)) > way;
  if (!turned && beyond(size, aside, most_aside) <= way) return {};
  return fmt::format("pull at {:.0f} degrees back from upright and {:.0f} to a side", back, aside);
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
