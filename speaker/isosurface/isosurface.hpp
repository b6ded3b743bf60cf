#pragma once
#include "forward/geometry/triangle_surface.hpp"
#include "speaker/isosurface/layered_field.hpp"

namespace genio {

/// The surface where a field changes its sign, with normals outwards: marching tetrahedra, six a
/// cell about its diagonal, so that no case is ambiguous and the surface is closed and manifold
/// whatever the values are. Outside the grid all is outside; the surface is cut off a fiftieth of a
/// cell beyond the grid's last nodes. Vertices keep that way from every node, too, and so from one
/// another. `place` gives a vertex's place [m] from its (u, v, w); it may mirror. Empty where
/// nothing is inside. Throws InputError where there would be more than 12 million triangles.
TriangleSurface isosurface(const LayeredField& field,
                           const std::function<Vec3(const Vec3&)>& place);

}  // namespace genio
