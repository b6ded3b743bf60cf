#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "forward/geometry/triangle_surface.hpp"

namespace genio {

/// A side of a triangle, as it runs along its edge.
struct TriangleSide {
  int low, high;  ///< the edge's vertices
  int triangle;
  bool rises;  ///< the triangle runs from low to high
};

/// All sides, those of one edge behind one another.
inline std::vector<TriangleSide> sides_by_edge(const TriangleSurface& surface) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * surface.triangles.size());
  for (size_t t = 0; t < surface.triangles.size(); ++t)
    for (size_t i = 0; i < 3; ++i) {
      const int a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), int(t), a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  return sides;
}

/// act(first side of an edge, past its last one) for every edge.
template <class Act>
void each_edge(const std::vector<TriangleSide>& sides, Act act) {
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const TriangleSide& s) {
      return s.low != first->low || s.high != first->high;
    });
    act(first, last);
    first = last;
  }
}

}  // namespace genio
