#pragma once
#include <array>
#include <vector>

#include "forward/polygons/polygons.hpp"

namespace genio {

/// Each face as triangles of point numbers. A quadrilateral is split at its inward corner where it
/// has one, another convex face from its last corner on, and an ear at a time is cut off the
/// others. Throws InputError naming `path` for a face that is not convex and has hundreds of
/// corners.
std::vector<std::array<int, 3>> triangulated(const Polygons& polygons, const std::string& path);

}  // namespace genio
