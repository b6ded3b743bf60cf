#pragma once
#include <string_view>

#include "forward/polygons/polygons.hpp"

namespace genio {

/// Wavefront OBJ: its lines `v` and `f`; all others, such as normals and materials, are passed
/// over, and no other file is opened. Throws InputError naming `path` and line.
Polygons read_obj(const std::string& path, std::string_view bytes);

}  // namespace genio
