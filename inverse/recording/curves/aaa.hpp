#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Tab-separated exports of Articulate Assistant Advanced, Cartesian or polar, with or without a
/// header.
ContourFormat aaa_format();

}  // namespace genio
