#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// AG501's text export: Ch1_X Ch1_Y Ch1_Z Ch1_phi Ch1_theta Ch1_RMS Ch1_Extra Ch2_X ..., as the
/// device writes it or as R and pandas write it again. Without a header it has 7 values a channel.
ContourFormat ag501_text_format();

}  // namespace genio
