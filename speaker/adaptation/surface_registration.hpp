#pragma once
#include <functional>

#include "forward/geometry/triangle_surface.hpp"
#include "speaker/elastic/fold_free.hpp"

namespace genio {

/// A mesh whose outer surface lies on a given one.
struct SurfaceRegistration {
  HexMesh mesh;
  double rms = 0, most = 0;  ///< distances of the outer surface from the given one [m]
  double min_jacobian = 0;   ///< smallest ratio of corner Jacobians
};

/// The affine map that lays a mesh's outer surface onto a closed surface: about the centres and
/// sizes at first, then by closest points (12 parameters).
HexMesh affinely_laid(const HexMesh& mesh, const TriangleSurface& target);

/// The mesh, as elastic tissue, with its outer surface drawn to a surface and free to slide along
/// it. Places of the mesh that are nearest to the rim of an open surface, or face another way than
/// it, are left alone. `more`: pulls beside, such as those of an outline, in the mesh's places.
/// The mesh must lie near the surface already.
SurfaceRegistration register_surface(
    const HexMesh& mesh, const TriangleSurface& target,
    const std::function<std::vector<Pull>(const Positions&)>& more = {});

/// The outer faces of a mesh as triangles that face outwards.
TriangleSurface outer_surface(const HexMesh& mesh);

}  // namespace genio
