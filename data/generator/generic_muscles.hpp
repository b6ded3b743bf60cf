#pragma once
#include <functional>
#include <vector>

#include "data/generator/generic_tongue.hpp"

namespace genio::generic {

/// Node number of grid point (i along, j deep, k across; k from -across to across).
using NodeAt = std::function<int(int, int, int)>;

/// The 11 muscles of the published table as fibres along grid lines, left and right.
std::vector<Muscle> make_muscles(const Resolution& r, const NodeAt& node, const HexMesh& mesh);

}  // namespace genio::generic
