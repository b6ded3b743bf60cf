#pragma once
#include <string>
#include <vector>

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// How a recording's bite plane is tilted, counter-clockwise from the axis that runs back, with up
/// as the other; and how well it tells the tilt of the model's occlusal plane [rad].
struct BitePlane {
  double tilt = 0, sd = 0;
};

/// The straight line through its trace, points (back, up) [m]. Throws InputError naming `path`
/// where they lie on none, or on one that is too short to tell.
BitePlane bite_plane_of(const std::vector<Vec2>& trace, const std::string& path);

}  // namespace genio
