#pragma once
#include "forward/geometry/triangle_surface.hpp"

namespace genio {

/// The part of largest area, without vertices that no triangle has. Specks of a segmentation, and
/// the walls of cavities inside, are parts of their own.
TriangleSurface largest_part(const TriangleSurface& surface);

/// Without vertices that no triangle has.
TriangleSurface without_loose_vertices(const TriangleSurface& surface);

}  // namespace genio
