#pragma once
// Points of the head beside the tongue that ultrasound shows, and what files call them.

#include <map>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// The hyoid; where the genioglossus' short tendon leaves the jaw; and the mandible's lower inner
/// edge, where its shadow begins.
enum class HeadPoint { hyoid, short_tendon, mandible };

/// "hyoid", "short tendon" or "mandible".
const char* name_of(HeadPoint point);

/// All places at which a file shows them, (along, up) in its own numbers.
using HeadPointTracks = std::map<HeadPoint, std::vector<Eigen::Vector2d>>;

/// Those that a body part or a spline is named for, in their order: of "DLC_HyoidMandible" hyoid
/// and mandible. Empty where the name holds any other word, as "geniohyoid" does.
std::vector<HeadPoint> head_points_in(const std::string& name);

}  // namespace genio
