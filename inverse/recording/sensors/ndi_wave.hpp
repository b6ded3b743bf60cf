#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// NDI Wave: time, then NAME Frame State Q0 Qx Qy Qz Tx Ty Tz a sensor; a State other than OK means
/// that the sensor was not seen.
ContourFormat ndi_wave_format();

}  // namespace genio
