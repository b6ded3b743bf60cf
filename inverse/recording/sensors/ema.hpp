#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Electromagnetic articulography: AG500 and AG501 .pos files, AG501's text export, SSFF tracks.
ContourFormat ema_format();

}  // namespace genio
