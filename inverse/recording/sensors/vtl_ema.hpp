#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// VocalTractLab .ema: time[s] TB-x[cm] TB-y[cm] ..., blank-separated, in centimetres.
ContourFormat vtl_ema_format();

}  // namespace genio
