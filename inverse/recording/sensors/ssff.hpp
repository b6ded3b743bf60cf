#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// SSFF tracks. Sensors are columns of 2 (x, z) or at least 3 (x, y, z) values, or scalar columns
/// that share a name but for x, y or z. Files of one take, "a.TT,a.TB", are joined by time.
ContourFormat ssff_format();

/// The files that a target names, separated by commas; one that exists under the whole name is it.
std::vector<std::string> joined_paths(const std::string& path);

}  // namespace genio
