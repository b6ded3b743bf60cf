#pragma once
#include <string_view>

#include "forward/polygons/polygons.hpp"

namespace genio {

/// PLY, ASCII or binary: the elements `vertex`, `face` and `tristrips`; others are passed over.
/// Throws InputError naming `path`, and line or element.
Polygons read_ply(const std::string& path, std::string_view bytes);

}  // namespace genio
