#include "forward/geometry/element_batches.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "forward/geometry/hex8.hpp"

namespace genio {

std::vector<ElementBatch> element_batches(const HexMesh& mesh) {
  const auto points = hex8::gauss_points();
  const int n = int(mesh.elements.size());
  std::vector<ElementBatch> batches(size_t((n + lanes::width - 1) / lanes::width));
  for (size_t b = 0; b < batches.size(); ++b) {
    ElementBatch& batch = batches[b];
    batch.count = std::min(lanes::width, n - int(b) * lanes::width);
    batch.volume = lanes::splat(0);
    for (int l = 0; l < lanes::width; ++l) {
      const int e = std::min(int(b) * lanes::width + l, n - 1);
      batch.element[l] = e;
      for (int a = 0; a < 8; ++a) batch.node[a][l] = mesh.elements[e][a];
      for (int q = 0; q < 8; ++q) {
        const auto d = hex8::derivatives(points[q]);
        const auto corner = [&](int a) -> const Vec3& { return mesh.nodes[mesh.elements[e][a]]; };
        const Mat3 jacobian = hex8::jacobian(corner, d);
        const Eigen::Matrix<double, 8, 3> gradient = d * jacobian.inverse();
        for (int a = 0; a < 8; ++a)
          for (int i = 0; i < 3; ++i) batch.gradient[q][a][i][l] = gradient(a, i);
        batch.weight[q][l] = jacobian.determinant();
        batch.volume[l] += jacobian.determinant();
      }
    }
  }
  return batches;
}

}  // namespace genio
