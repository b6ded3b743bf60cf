#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// SSFF tracks. Sensors are columns of 2 (x, z) or at least 3 (x, y, z) values, or scalar columns
/// that share a name but for a last x, y or z. Throws InputError naming file and line.
RawContours read_ssff(const std::string& path, const ReadOptions& options);

}  // namespace genio
