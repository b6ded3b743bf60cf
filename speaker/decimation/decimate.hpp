#pragma once
#include <optional>

#include "forward/geometry/triangle_surface.hpp"
#include "speaker/solid/kept_region.hpp"

namespace genio {

struct DecimateOptions {
  int triangles = 0;                         ///< to come down to; 0: as few as the bounds let
  std::optional<double> distance = {};       ///< bound of the Hausdorff distance [m]
  KeptRegion keep = {};                      ///< stays finer
  std::optional<double> keep_distance = {};  ///< bound there [m]; else 0.3 of the other
};

struct DecimatedSurface {
  TriangleSurface surface;
  double hausdorff;       ///< between it and the surface before, measured to 2 micrometres [m]
  double hausdorff_kept;  ///< of places in the region to keep [m]; 0 without one
  bool reached;           ///< it has no more triangles than asked for
  bool within_bounds;     ///< the measured distances keep to the bounds
};

/// Joins vertices along edges, those first that raise the sum of squared distances to the planes of
/// the triangles before least (Garland and Heckbert 1997); in the region to keep these count more,
/// by the square of the bounds' ratio. No triangle turns over; what is closed and manifold stays
/// so; a rim stays in its place, and edges of three triangles are left alone. Bounds come before
/// the number of triangles: where they forbid it, more are left.
DecimatedSurface decimate(const TriangleSurface& surface, const DecimateOptions& options);

}  // namespace genio
