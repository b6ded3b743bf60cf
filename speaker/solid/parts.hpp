#pragma once
#include <vector>

#include "speaker/solid/edge_list.hpp"

namespace genio {

/// For each triangle the number of its part, from 0; parts are joined by edges.
std::vector<int> part_of_triangles(const TriangleSurface& surface,
                                   const std::vector<TriangleSide>& sides);

}  // namespace genio
