#pragma once
// Four elements at a time: one double of each in the lanes of a vector register.

#include <cmath>

namespace genio::lanes {

inline constexpr int width = 8;
using Lane = double __attribute__((vector_size(width * sizeof(double))));

inline Lane splat(double v) { return Lane{} + v; }

/// v^(-2/3) in each lane.
inline Lane inverse_two_thirds(Lane v) {
  Lane r;
  for (int l = 0; l < width; ++l) {
    const double c = 1.0 / std::cbrt(v[l]);
    r[l] = c * c;
  }
  return r;
}

/// True where any of the first `count` lanes is not above zero (NaN counts as not above).
inline bool any_not_positive(Lane v, int count) {
  for (int l = 0; l < count; ++l)
    if (!(v[l] > 0)) return true;
  return false;
}

}  // namespace genio::lanes
