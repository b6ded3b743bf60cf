#include "speaker/adaptation/stack_sides.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "speaker/slices/stack_surface.hpp"

namespace genio {
namespace {

/// Unit normal of a slice's plane, by its first outline's area (Newell).
Vec3 slice_normal(const std::vector<Vec3>& outline) {
  Vec3 sum = Vec3::Zero();
  for (size_t k = 0; k < outline.size(); ++k)
    sum += outline[k].cross(outline[(k + 1) % outline.size()]);
  return sum.normalized();
}

}  // namespace

TriangleSurface stack_sides(const ContourStack& stack) {
  const StackedSurface made = stack_surface(stack);
  TriangleSurface sides{made.surface.vertices, {}};
  const auto on_end = [&](const std::array<int, 3>& t) {
    for (const StackSlice* slice : {&stack.slices.front(), &stack.slices.back()}) {
      const Vec3 normal = slice_normal(slice->outlines.front());
      const Vec3& in_plane = slice->outlines.front().front();
      if (std::all_of(t.begin(), t.end(), [&](int a) {
            return std::abs(normal.dot(made.surface.vertices[size_t(a)] - in_plane)) <
                   0.1 * made.step;
          }))
        return true;
    }
    return false;
  };
  for (const auto& t : made.surface.triangles)
    if (!on_end(t)) sides.triangles.push_back(t);
  return sides;
}

}  // namespace genio
