#pragma once
#include "forward/geometry/triangle_surface.hpp"
#include "speaker/slices/contour_stack.hpp"

namespace genio {

/// The surface through the outlines of a stack without its two flat ends, of which the slices say
/// nothing: an open surface. Throws InputError where the stack cannot be used, as stack_surface()
/// does.
TriangleSurface stack_sides(const ContourStack& stack);

}  // namespace genio
