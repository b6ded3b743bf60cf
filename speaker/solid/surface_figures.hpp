#pragma once
// What can be said of a surface by counting and summing over it.

#include "forward/geometry/triangle_surface.hpp"

namespace genio {

struct SurfaceFigures {
  int triangles, vertices, parts;  ///< parts: pieces that no edge connects
  bool closed;                     ///< every edge has two triangles or more
  /// Every edge has at most two triangles, which traverse it in opposite directions, and those at a
  /// vertex are one fan.
  bool manifold;
  int euler;      ///< vertices - edges + triangles; 2 for a ball, 2 less a handle
  double area;    ///< [m^2]
  double volume;  ///< [m^3], positive where the normals point outwards; of a closed surface
};

/// Vertices that no triangle has are not counted.
SurfaceFigures surface_figures(const TriangleSurface& surface);

/// The volume within [m^3]; negative where the normals point inwards.
double enclosed_volume(const TriangleSurface& surface);

}  // namespace genio
