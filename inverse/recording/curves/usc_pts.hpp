#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Landmarks of one image, as USC-TIMIT's refined ones: `version: 1`, `n_points: N`, and pixels x y
/// between braces. Where they show more than a tongue, the options' points say which are its own.
ContourFormat usc_pts_format();

}  // namespace genio
