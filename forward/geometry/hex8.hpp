#pragma once
// Trilinear shape functions of the 8-node hexahedron on [-1, 1]^3.

#include <array>
#include <cmath>

#include "forward/base/types.hpp"

namespace genio::hex8 {

inline constexpr std::array<std::array<int, 3>, 8> corner = {{{-1, -1, -1},
                                                              {1, -1, -1},
                                                              {1, 1, -1},
                                                              {-1, 1, -1},
                                                              {-1, -1, 1},
                                                              {1, -1, 1},
                                                              {1, 1, 1},
                                                              {-1, 1, 1}}};

/// The six faces, nodes counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> face = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Integration points of the 2x2x2 Gauss rule; every weight is 1.
inline std::array<Vec3, 8> gauss_points() {
  const double g = 1.0 / std::sqrt(3.0);
  std::array<Vec3, 8> points;
  for (int q = 0; q < 8; ++q)
    points[q] = Vec3(corner[q][0] * g, corner[q][1] * g, corner[q][2] * g);
  return points;
}

/// Values of the 8 shape functions at `xi`.
inline std::array<double, 8> values(const Vec3& xi) {
  std::array<double, 8> n;
  for (int a = 0; a < 8; ++a)
    n[a] = 0.125 * (1 + corner[a][0] * xi[0]) * (1 + corner[a][1] * xi[1]) *
           (1 + corner[a][2] * xi[2]);
  return n;
}

/// Derivatives of the shape functions with respect to `xi`, one row a node.
inline Eigen::Matrix<double, 8, 3> derivatives(const Vec3& xi) {
  Eigen::Matrix<double, 8, 3> d;
  for (int a = 0; a < 8; ++a) {
    const auto& c = corner[a];
    const double u = 1 + c[0] * xi[0], v = 1 + c[1] * xi[1], w = 1 + c[2] * xi[2];
    d.row(a) << 0.125 * c[0] * v * w, 0.125 * u * c[1] * w, 0.125 * u * v * c[2];
  }
  return d;
}

/// Jacobian matrix of the trilinear map whose corner `a` lies at position(a), from derivatives().
template <class Position>
Mat3 jacobian(const Position& position, const Eigen::Matrix<double, 8, 3>& derivative) {
  Mat3 j = Mat3::Zero();
  for (int a = 0; a < 8; ++a) j += position(a) * derivative.row(a);
  return j;
}

}  // namespace genio::hex8
