#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// AAA's export of polar coordinates: one spline a row, its radii [mm] and angles [rad]. Throws
/// InputError naming file, line and knot.
RawContours read_aaa_polar(const std::string& path);

/// True where the header has the columns of such an export.
bool has_polar_blocks(const std::string& path);

}  // namespace genio
