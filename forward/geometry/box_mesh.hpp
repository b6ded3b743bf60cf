#pragma once
#include <array>

#include "forward/geometry/mesh.hpp"

namespace genio {

/// A box from the origin to `size` [m] in equal hexahedra; node (i, j, k) is number
/// (k (cells_y + 1) + j) (cells_x + 1) + i.
HexMesh box_mesh(const Vec3& size, const std::array<int, 3>& cells);

}  // namespace genio
