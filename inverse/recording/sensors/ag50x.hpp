#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Carstens .pos: 7 little-endian floats a channel and sample. AG501 has a header; AG500 has none
/// and 12 channels at 200 Hz. Of a file cut short, the whole samples are read, and it is said.
ContourFormat ag50x_format();

}  // namespace genio
