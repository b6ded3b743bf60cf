#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Tables of GetContours, tab-separated with a header: long or wide, in millimetres or pixels.
ContourFormat getcontours_format();

}  // namespace genio
