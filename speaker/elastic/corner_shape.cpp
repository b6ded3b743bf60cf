#include "speaker/elastic/corner_shape.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "forward/geometry/hex8.hpp"

namespace genio {
namespace {

std::array<std::array<EdgeEnds, 3>, 8> all_corner_edges() {
  std::array<std::array<EdgeEnds, 3>, 8> ends{};
  for (size_t c = 0; c < 8; ++c)
    for (size_t k = 0; k < 3; ++k) {
      auto other = hex8::corner[c];
      other[k] = -other[k];
      for (size_t b = 0; b < 8; ++b)
        if (hex8::corner[b] == other)
          ends[c][k] = other[k] > 0 ? EdgeEnds{int(c), int(b)} : EdgeEnds{int(b), int(c)};
    }
  return ends;
}

}  // namespace

EdgeEnds corner_edge(int c, int k) {
  static const auto ends = all_corner_edges();
  return ends[size_t(c)][size_t(k)];
}

double corner_energy(const Mat3& f) {
  const double det = f.determinant();
  if (!(det > 0)) return std::numeric_limits<double>::infinity();
  // |F^-1| = |cofactor of F| / det F.
  Mat3 cofactor;
  cofactor.col(0) = f.col(1).cross(f.col(2));
  cofactor.col(1) = f.col(2).cross(f.col(0));
  cofactor.col(2) = f.col(0).cross(f.col(1));
  return f.squaredNorm() + cofactor.squaredNorm() / (det * det) - 6;
}

CornerEnergy corner_energy_with_derivatives(const Mat3& f) {
  const Eigen::JacobiSVD<Mat3> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat3 &u = svd.matrixU(), &v = svd.matrixV();
  const Vec3& s = svd.singularValues();  // det F > 0, so U V^T is a rotation
  // A sum of g(s) = s^2 + 1/s^2 - 2 over the singular values.
  const Vec3 slope = 2 * (s.array() - s.array().pow(-3));
  CornerEnergy e;
  e.value = (s.array().square() + s.array().pow(-2) - 2).sum();
  e.gradient = u * slope.asDiagonal() * v.transpose();
  for (int k = 0; k < 3; ++k) {
    e.direction[size_t(k)] = u.col(k) * v.col(k).transpose();
    e.stiffness[size_t(k)] = 2 + 6 * std::pow(s[k], -4);
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Mat3 there = u.col(i) * v.col(j).transpose(), back = u.col(j) * v.col(i).transpose();
    e.direction[size_t(3 + k)] = std::sqrt(0.5) * (there - back);
    e.stiffness[size_t(3 + k)] = std::max(0.0, (slope[i] + slope[j]) / (s[i] + s[j]));
    e.direction[size_t(6 + k)] = std::sqrt(0.5) * (there + back);
    // (g'(a) - g'(b)) / (a - b), which has no difference in it once divided out.
    const double a = s[i], b = s[j];
    e.stiffness[size_t(6 + k)] = 2 + 2 * (a * a + a * b + b * b) / std::pow(a * b, 3);
  }
  return e;
}

}  // namespace genio
