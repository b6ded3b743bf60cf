#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// A row a point, a pair of columns a frame: EdgeTrak's .con without a header, GetContours' table
/// for EdgeTrak with two, and plain tables separated by commas.
ContourFormat edgetrak_format();

}  // namespace genio
