#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// 3D scans: the vertices of a PLY, OBJ or STL surface, in any frame.
ContourFormat scan_format();

}  // namespace genio
