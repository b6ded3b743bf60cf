#pragma once
#include <Eigen/Dense>

#include "forward/base/types.hpp"

namespace genio {

/// A weighted sum of squared distances to planes, as a function of the place (Garland and Heckbert
/// 1997): x'A x + 2 b'x + c about an origin of its own, so that no digits are lost.
struct Quadric {
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0;

  /// Adds the plane through `at` with a normal of length 1.
  void add_plane(const Vec3& normal, const Vec3& at, double weight) {
    const double d = normal.dot(at);
    a += weight * normal * normal.transpose();
    b -= weight * d * normal;
    c += weight * d * d;
  }
  Quadric& operator+=(const Quadric& other) {
    a += other.a, b += other.b, c += other.c;
    return *this;
  }
  double at(const Vec3& x) const { return std::max(0.0, x.dot(a * x) + 2 * b.dot(x) + c); }
  /// Where it is least; along directions in which it hardly changes, as near to `middle` as may be.
  Vec3 least(const Vec3& middle) const {
    constexpr double hardly = 1e-3;  // of the mean curvature
    const double trace = a.trace();
    if (!(trace > 0)) return middle;
    return middle - (a + hardly / 3 * trace * Mat3::Identity()).ldlt().solve(a * middle + b);
  }
};

}  // namespace genio
