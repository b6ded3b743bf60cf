#pragma once
#include "forward/geometry/triangle_surface.hpp"

namespace genio::generic {

/// Hard and soft palate and rear pharyngeal wall, arched across [m].
TriangleSurface make_palate();
/// Inner face of the mandible with the lower teeth, a U seen from above [m].
TriangleSurface make_jaw();
/// Hyoid bone: a bent tube with two horns [m].
TriangleSurface make_hyoid();

}  // namespace genio::generic
