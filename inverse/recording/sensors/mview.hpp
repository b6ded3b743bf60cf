#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// MVIEW's MATLAB files (Haskins): an array of structures, one a trajectory, with NAME, SRATE and
/// SIGNAL (samples by x, y, z and angles, in mm, x forwards and z up). As a palate, any matrix of
/// two or three columns.
ContourFormat mview_format();

}  // namespace genio
