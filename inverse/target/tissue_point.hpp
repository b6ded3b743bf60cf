#pragma once
#include <utility>
#include <vector>

#include "forward/geometry/mesh.hpp"

namespace genio {

/// Nodes and shares of the tissue point that lies at `rest` in the rest shape [m]. Throws
/// InputError when that is outside the tongue.
std::vector<std::pair<int, double>> tissue_point(const HexMesh& mesh, const Vec3& rest);

}  // namespace genio
