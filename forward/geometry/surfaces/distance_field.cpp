#include "forward/geometry/distance_field.hpp"

#include <cmath>
#include <limits>

#include "forward/geometry/closest_point.hpp"

namespace genio {
namespace {

constexpr double far_away = 0.05;  // [m]; also the largest distance kept
constexpr double band = 0.008;     // samples farther away than this need no exact distance [m]
constexpr int coarse = 6;          // samples along the side of a block that may be skipped whole

/// Weights of the 4 uniform cubic B-splines that reach `t` in [0, 1], and their derivatives.
struct Basis {
  double n[4], d[4], dd[4];
  explicit Basis(double t) {
    const double s = 1 - t;
    n[0] = s * s * s / 6, n[3] = t * t * t / 6;
    n[1] = (3 * t * t * t - 6 * t * t + 4) / 6;
    n[2] = (3 * s * s * s - 6 * s * s + 4) / 6;
    d[0] = -s * s / 2, d[1] = (3 * t * t - 4 * t) / 2, d[2] = -(3 * s * s - 4 * s) / 2,
    d[3] = t * t / 2;
    dd[0] = s, dd[1] = 3 * t - 2, dd[2] = 3 * s - 2, dd[3] = t;
  }
};

}  // namespace

DistanceField::DistanceField(const TriangleSurface& surface, const Vec3& low, const Vec3& high,
                             double spacing, const std::vector<Vec3>& inside_points)
    : low_(low), spacing_(spacing) {
  nx_ = int((high[0] - low[0]) / spacing) + 4;
  ny_ = int((high[1] - low[1]) / spacing) + 4;
  nz_ = int((high[2] - low[2]) / spacing) + 4;
  const SurfaceDistance distance(surface);
  double vote = 0;  // near points know their side best
  for (const Vec3& p : inside_points) {
    const double d = distance(p);
    vote += d / (d * d + 1e-6);
  }
  const double sign = vote >= 0 ? 1.0 : -1.0;
  const auto bounded = [&](const Vec3& p) {
    return std::min(far_away, std::max(-far_away, sign * distance(p)));
  };
  samples_.resize(size_t(nx_) * ny_ * nz_);
  const double half_diagonal = 0.5 * std::sqrt(3.0) * (coarse - 1) * spacing;
  for (int k0 = 0; k0 < nz_; k0 += coarse)
    for (int j0 = 0; j0 < ny_; j0 += coarse)
      for (int i0 = 0; i0 < nx_; i0 += coarse) {
        const double middle = 0.5 * (coarse - 1);
        const double centre = bounded(low + spacing * Vec3(i0 + middle, j0 + middle, k0 + middle));
        const bool skip = std::abs(centre) > band + half_diagonal;
        for (int k = k0; k < std::min(nz_, k0 + coarse); ++k)
          for (int j = j0; j < std::min(ny_, j0 + coarse); ++j)
            for (int i = i0; i < std::min(nx_, i0 + coarse); ++i)
              samples_[(size_t(k) * ny_ + j) * nx_ + i] =
                  skip ? centre : bounded(low + spacing * Vec3(i, j, k));
      }
}

bool DistanceField::locate(const Vec3& p, std::array<int, 3>& cell, Vec3& fraction) const {
  const int size[3] = {nx_, ny_, nz_};
  for (int d = 0; d < 3; ++d) {
    const double s = (p[d] - low_[d]) / spacing_;
    if (!(s >= 1) || s >= size[d] - 2) return false;
    cell[d] = int(s) - 1;
    fraction[d] = s - std::floor(s);
  }
  return true;
}

double DistanceField::value(const Vec3& p) const {
  std::array<int, 3> c;
  Vec3 t;
  if (!locate(p, c, t)) return far_away;
  const Basis x(t[0]), y(t[1]), z(t[2]);
  double v = 0;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      double row = 0;
      for (int i = 0; i < 4; ++i) row += x.n[i] * at(c[0] + i, c[1] + j, c[2] + k);
      v += row * y.n[j] * z.n[k];
    }
  return v;
}

DistanceSample DistanceField::sample(const Vec3& p) const {
  std::array<int, 3> c;
  Vec3 t;
  DistanceSample s{far_away, Vec3::Zero(), Mat3::Zero()};
  if (!locate(p, c, t)) return s;
  s.value = 0;
  const Basis x(t[0]), y(t[1]), z(t[2]);
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      double n = 0, d = 0, dd = 0;
      for (int i = 0; i < 4; ++i) {
        const double v = at(c[0] + i, c[1] + j, c[2] + k);
        n += x.n[i] * v, d += x.d[i] * v, dd += x.dd[i] * v;
      }
      s.value += n * y.n[j] * z.n[k];
      s.gradient += Vec3(d * y.n[j] * z.n[k], n * y.d[j] * z.n[k], n * y.n[j] * z.d[k]);
      s.hessian(0, 0) += dd * y.n[j] * z.n[k];
      s.hessian(1, 1) += n * y.dd[j] * z.n[k];
      s.hessian(2, 2) += n * y.n[j] * z.dd[k];
      s.hessian(1, 0) += d * y.d[j] * z.n[k];
      s.hessian(2, 0) += d * y.n[j] * z.d[k];
      s.hessian(2, 1) += n * y.d[j] * z.d[k];
    }
  s.gradient /= spacing_;
  s.hessian /= spacing_ * spacing_;
  s.hessian.triangularView<Eigen::StrictlyUpper>() = s.hessian.transpose();
  return s;
}

}  // namespace genio
