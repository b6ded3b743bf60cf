#pragma once
#include <string_view>

#include "forward/polygons/polygons.hpp"

namespace genio {

/// STL, binary where the length is what its number of triangles takes, else ASCII. Each triangle
/// has points of its own. Throws InputError naming `path` and line.
Polygons read_stl(const std::string& path, std::string_view bytes);

}  // namespace genio
