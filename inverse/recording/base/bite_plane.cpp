#include "inverse/recording/base/bite_plane.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace genio {
namespace {

// The model's occlusal plane is taken for horizontal. Its incisors and molars would tell 4 degrees,
// others give 10 for the same head.
constexpr double own_sd = 6 * std::numbers::pi / 180;
constexpr double shortest_trace = 3e-3;  // standard deviation along it [m]
constexpr double most_bent = 0.2;        // of that, across it

}  // namespace

BitePlane bite_plane_of(const std::vector<Vec2>& trace, const std::string& path) {
  Vec2 middle = Vec2::Zero(), squares = Vec2::Zero();
  double mixed = 0;
  for (const Vec2& q : trace) middle += q / double(trace.size());
  for (const Vec2& q : trace) {
    const Vec2 off = q - middle;
    squares += off.cwiseAbs2() / double(trace.size());
    mixed += off[0] * off[1] / double(trace.size());
  }
  const double half = 0.5 * (squares[0] + squares[1]),
               apart = std::hypot(0.5 * (squares[0] - squares[1]), mixed);
  const double along = std::sqrt(half + apart), across = std::sqrt(std::max(0.0, half - apart));
  if (!(along > shortest_trace))
    throw InputError(
        fmt::format("{}: the bite plane's points lie within {:.1f} mm; expected a line "
                    "or sensors that are 10 mm apart or more",
                    path, 2e3 * along));
  if (across > most_bent * along)
    throw InputError(
        fmt::format("{}: the bite plane's points lie {:.1f} mm off a straight line of "
                    "{:.0f} mm; are they another curve's?",
                    path, 1e3 * across, 2e3 * std::sqrt(3.0) * along));
  return {0.5 * std::atan2(2 * mixed, squares[0] - squares[1]), std::hypot(own_sd, across / along)};
}

}  // namespace genio
