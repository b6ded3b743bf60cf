#pragma once
// How far two surfaces are apart.

#include "forward/geometry/surfaces/closest_point.hpp"
#include "speaker/solid/kept_region.hpp"

namespace genio {

/// The largest distance of a place on `from` to the surface `to` [m], found to
/// within `tolerance` [m]: a true distance of some place, which no other place exceeds by more.
/// Triangles are split where one may be farther off; between three places that are nearest to one
/// triangle no place is farther from it, as the distance to a triangle is convex. With `within`,
/// only of places in that region; 0 where there are none. `distance` measures to `to`.
double farthest_from(const TriangleSurface& from, const TriangleSurface& to,
                     const SurfaceDistance& distance, double tolerance,
                     const KeptRegion* within = nullptr);

/// The larger of both ways between two surfaces [m].
double hausdorff_distance(const TriangleSurface& a, const TriangleSurface& b,
                          double tolerance = 2e-6, const KeptRegion* within = nullptr);

}  // namespace genio
