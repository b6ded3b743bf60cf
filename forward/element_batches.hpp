#pragma once
#include <array>
#include <vector>

#include "forward/lanes.hpp"
#include "forward/mesh.hpp"

namespace genio {

/// Shape function gradients and weights at the 2x2x2 Gauss points of `lanes::width` elements side
/// by side, in the mesh's own shape.
struct ElementBatch {
  using Lane = lanes::Lane;
  std::array<std::array<std::array<Lane, 3>, 8>, 8> gradient;  ///< dN_a/dX at Gauss point q [1/m]
  std::array<Lane, 8> weight;                                  ///< [m^3]
  Lane volume;                                                 ///< [m^3]
  std::array<std::array<int, lanes::width>, 8> node;
  std::array<int, lanes::width> element;
  int count;  ///< lanes in use; the rest repeat the last element
};

std::vector<ElementBatch> element_batches(const HexMesh& mesh);

}  // namespace genio
