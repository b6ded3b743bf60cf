#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace genio {

/// How much each of four neighbouring values counts for a slope or a place between the middle two.
struct FourHeights {
  std::array<double, 4> h;  ///< of the values, rising; the outer two may be repeated at an end
  bool first, last;         ///< nothing stands before the second, behind the third
};

/// A value between the middle two of four, by a cubic with the slopes of parabolas through three
/// neighbours. No slope exceeds three times that of the lesser side: a value that changes suddenly,
/// as where a branch of a body ends, does not make its neighbours swing.
inline double limited_spline(const FourHeights& at, const std::array<double, 4>& f, double t) {
  const double gap = at.h[2] - at.h[1], d = (f[2] - f[1]) / gap;
  const auto slope = [](double d0, double g0, double d1, double g1) {
    const double m = (d0 * g1 + d1 * g0) / (g0 + g1);
    const double most = 3 * std::min(std::abs(d0), std::abs(d1));
    return std::clamp(m, -most, most);
  };
  const double before = at.first ? d : (f[1] - f[0]) / (at.h[1] - at.h[0]);
  const double behind = at.last ? d : (f[3] - f[2]) / (at.h[3] - at.h[2]);
  double m1 = at.first ? 0 : slope(before, at.h[1] - at.h[0], d, gap);
  double m2 = at.last ? 0 : slope(d, gap, behind, at.h[3] - at.h[2]);
  // At an end: the parabola through three values, or a straight line between two.
  if (at.first) m1 = at.last ? d : std::clamp(2 * d - m2, -3 * std::abs(d), 3 * std::abs(d));
  if (at.last) m2 = at.first ? d : std::clamp(2 * d - m1, -3 * std::abs(d), 3 * std::abs(d));
  const double s = 1 - t;
  return s * s * (1 + 2 * t) * f[1] + t * t * (1 + 2 * s) * f[2] + gap * t * s * (s * m1 - t * m2);
}

}  // namespace genio
