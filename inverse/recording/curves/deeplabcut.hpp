#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Tables of DeepLabCut: header rows scorer, bodyparts, coords, then x, y and likelihood of each
/// part in pixels. Parts of the tongue are the points of its curve.
ContourFormat deeplabcut_format();

}  // namespace genio
