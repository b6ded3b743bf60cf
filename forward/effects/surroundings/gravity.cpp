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

/// What is met lies between upright, with the head bowed a little, and supine, and little to a
/// side.
std::string implausible(EffectParameters p) {
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

}  // namespace

Gravity::Gravity(const NodeMatrix& mass, const Vec3& acceleration, double pitch)
    : mass_(mass * Vector::Ones(mass.cols())) {
  const char* axis[] = {"x", "y", "z"};
  for (size_t i = 0; i < 3; ++i)
    info_[i] = {.name = axis[i],
                .unit = "m/s^2",
                .value = acceleration[Eigen::Index(i)],
                .lower = -20,
                .upper = 20,
                .load = true};
  info_[3] = {.name = "pitch", .unit = "deg", .value = pitch, .lower = -180, .upper = 180};
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

EffectKind gravity_kind() {
  return {.name = "gravity",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const Vec3 g = s.take_point("", Vec3(0, 0, -9.81));
            return {.potential = std::make_shared<Gravity>(a.mass, g, s.take("pitch", 0))};
          },
          .main = "pitch",
          .external = true,
          // The box about what is plausible; more is for pitch.
          .belief = {.parameters = {{.parameter = "x", .typical = 9.81, .least = -4, .most = 20},
                                    {.parameter = "y", .typical = 1, .least = -2.5, .most = 2.5},
                                    {.parameter = "z", .typical = 9.81, .least = -20, .most = 0}},
                     // A vector: its three parts at once.
                     .variants =
                         [](std::span<const ParameterInfo>) {
                           return std::vector<Variant>{{.numbers = {{0}, {1}, {2}}}};
                         },
                     .implausible = implausible},
          .sample = {{"x", 1}, {"y", 0.5}, {"z", -9.81}, {"pitch", 20}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_table(
                    "gravity",
                    [](double s) {
                      return EffectTable{{"x", 0}, {"y", 0}, {"z", -9.81 * s}};
                    },
                    1, 2);
              }};
}

}  // namespace genio
