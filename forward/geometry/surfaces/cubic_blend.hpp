#pragma once
// Uniform cubic B-splines over a grid.

#include "forward/base/types.hpp"

namespace genio {

/// Value, gradient and Hessian of a distance at a point.
struct DistanceSample {
  double value;  ///< [m]
  Vec3 gradient;
  Mat3 hessian;  ///< [1/m]
};

/// Weights of the 4 uniform cubic B-splines that reach `t` in [0, 1], and their derivatives.
struct CubicBlend {
  double n[4], d[4], dd[4];

  explicit CubicBlend(double t) {
    const double s = 1 - t;
    n[0] = s * s * s / 6, n[3] = t * t * t / 6;
    n[1] = (3 * t * t * t - 6 * t * t + 4) / 6;
    n[2] = (3 * s * s * s - 6 * s * s + 4) / 6;
    d[0] = -s * s / 2, d[1] = (3 * t * t - 4 * t) / 2, d[2] = -(3 * s * s - 4 * s) / 2,
    d[3] = t * t / 2;
    dd[0] = s, dd[1] = 3 * t - 2, dd[2] = 3 * s - 2, dd[3] = t;
  }
};

/// Four coefficients in a row.
inline Eigen::Array4d four(const float* row) {
  return Eigen::Map<const Eigen::Array4f>(row).cast<double>();
}

/// The spline at `fraction` within a cell; row(j, k) points to the 4 coefficients
/// along x there.
template <class Row>
double blended_value(const Vec3& fraction, Row row) {
  const CubicBlend x(fraction[0]), y(fraction[1]), z(fraction[2]);
  Eigen::Array4d along = Eigen::Array4d::Zero();  // summed over y and z, four at once
  for (int k = 0; k < 4; ++k) {
    Eigen::Array4d plane = y.n[0] * four(row(0, k));
    for (int j = 1; j < 4; ++j) plane += y.n[j] * four(row(j, k));
    along += z.n[k] * plane;
  }
  return (along * Eigen::Map<const Eigen::Array4d>(x.n)).sum();
}

/// The same with derivatives, for cells of the given size [m].
template <class Row>
DistanceSample blended_sample(const Vec3& fraction, double spacing, Row row) {
  const CubicBlend x(fraction[0]), y(fraction[1]), z(fraction[2]);
  DistanceSample s{0, Vec3::Zero(), Mat3::Zero()};
  // For each derivative along y and z (0 to 2 of them together), sums over y and z.
  Eigen::Array4d none = Eigen::Array4d::Zero(), by_y = none, by_z = none, yy = none, zz = none,
                 yz = none;
  for (int k = 0; k < 4; ++k) {
    Eigen::Array4d n = Eigen::Array4d::Zero(), d = n, dd = n;
    for (int j = 0; j < 4; ++j) {
      const Eigen::Array4d v = four(row(j, k));
      n += y.n[j] * v, d += y.d[j] * v, dd += y.dd[j] * v;
    }
    none += z.n[k] * n, by_y += z.n[k] * d, yy += z.n[k] * dd;
    by_z += z.d[k] * n, yz += z.d[k] * d, zz += z.dd[k] * n;
  }
  const Eigen::Map<const Eigen::Array4d> xn(x.n), xd(x.d), xdd(x.dd);
  s.value = (xn * none).sum();
  s.gradient = Vec3((xd * none).sum(), (xn * by_y).sum(), (xn * by_z).sum());
  s.hessian(0, 0) = (xdd * none).sum();
  s.hessian(1, 1) = (xn * yy).sum();
  s.hessian(2, 2) = (xn * zz).sum();
  s.hessian(1, 0) = (xd * by_y).sum();
  s.hessian(2, 0) = (xd * by_z).sum();
  s.hessian(2, 1) = (xn * yz).sum();
  s.gradient /= spacing;
  s.hessian /= spacing * spacing;
  s.hessian.triangularView<Eigen::StrictlyUpper>() = s.hessian.transpose();
  return s;
}

}  // namespace genio
