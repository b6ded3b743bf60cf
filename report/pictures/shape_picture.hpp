#pragma once
#include <string>

#include "forward/model/model.hpp"

namespace genio {

/// The deformed tongue (blue) over the one at rest (grey), in the midsagittal plane with bones, and
/// from the front: an SVG.
std::string draw_shape(const Model& model, const Positions& x, const std::string& title);

}  // namespace genio
