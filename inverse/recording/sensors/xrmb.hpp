#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// X-ray microbeam .txy: time in microseconds, then x and y of UL LL T1 T2 T3 T4 MNI MNM in
/// micrometres; 1000000 is missing. x grows forwards, y up.
ContourFormat xrmb_format();

/// A speaker's palate beside them, jwNN_pal.dat: x and y a row, in micrometres.
ContourFormat xrmb_palate_format();

}  // namespace genio
