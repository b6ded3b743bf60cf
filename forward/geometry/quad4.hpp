#pragma once
// Bilinear shape functions of the 4-node face on [-1, 1]^2, at the 2 x 2 Gauss points (weight 1).

#include <array>
#include <cmath>

namespace genio::quad4 {

struct Point {
  std::array<double, 4> value;              ///< N_a
  std::array<std::array<double, 2>, 4> by;  ///< dN_a/dxi, dN_a/deta
};

inline std::array<Point, 4> gauss_points() {
  constexpr int corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::array<Point, 4> points;
  for (int q = 0; q < 4; ++q) {
    const double u = corner[q][0] / std::sqrt(3.0), v = corner[q][1] / std::sqrt(3.0);
    for (int a = 0; a < 4; ++a) {
      const int c = corner[a][0], d = corner[a][1];
      points[q].value[a] = 0.25 * (1 + c * u) * (1 + d * v);
      points[q].by[a] = {0.25 * c * (1 + d * v), 0.25 * d * (1 + c * u)};
    }
  }
  return points;
}

}  // namespace genio::quad4
