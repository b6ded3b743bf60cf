#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// EST_Track, ASCII or binary, as MOCHA and mngu0 have them: time, a flag and a value a channel,
/// whose names are in the header. MOCHA's are in 1/100 mm.
ContourFormat est_track_format();

/// MOCHA's tracks as text without a header: time, flag and 20 channels in 1/100 mm.
ContourFormat mocha_format();

}  // namespace genio
