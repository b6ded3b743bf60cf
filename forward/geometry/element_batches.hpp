#pragma once
#include <array>
#include <vector>

#include "forward/geometry/lanes.hpp"
#include "forward/geometry/mesh.hpp"

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

/// A nodal field (3 n) at the corners of the batch's elements.
inline std::array<std::array<lanes::Lane, 3>, 8> gather(const ElementBatch& batch,
                                                        const Vector& field) {
  std::array<std::array<lanes::Lane, 3>, 8> corner;
  for (int a = 0; a < 8; ++a)
    for (int l = 0; l < lanes::width; ++l)
      for (int i = 0; i < 3; ++i) corner[a][i][l] = field[3 * batch.node[a][l] + i];
  return corner;
}

/// Its gradient with respect to X at Gauss point q.
inline void gradient(const ElementBatch& batch, int q,
                     const std::array<std::array<lanes::Lane, 3>, 8>& corner,
                     lanes::Lane (&g)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      g[i][j] = corner[0][i] * batch.gradient[q][0][j];
      for (int a = 1; a < 8; ++a) g[i][j] += corner[a][i] * batch.gradient[q][a][j];
    }
}

std::vector<ElementBatch> element_batches(const HexMesh& mesh);

}  // namespace genio
