#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Any long table with a header, a row a point: the options say which column is what, or their
/// titles do. Tables of R and pandas with names of rows, MTracker's.
ContourFormat columns_format();

}  // namespace genio
