#pragma once
// Four elements at a time: one double of each in the lanes of a vector register.

namespace genio::lanes {

inline constexpr int width = 8;
using Lane = double __attribute__((vector_size(width * sizeof(double))));

inline Lane splat(double v) { return Lane{} + v; }

/// v^(-2/3) in each lane, for finite v > 0: a guess from the exponent's bits, then Newton's method
/// for r^3 = v^-2, which needs no division.
inline Lane inverse_two_thirds(Lane v) {
  using Bits = long long __attribute__((vector_size(width * sizeof(long long))));
  // Reading a double's bits as an integer is nearly linear in its logarithm.
  constexpr double one = 4607182418800017408.0;  // bits of 1.0
  const Lane logarithm = __builtin_convertvector((Bits)v, Lane) - one;
  Lane r = (Lane) __builtin_convertvector(one - (2.0 / 3.0) * logarithm, Bits);
  const Lane v2 = v * v;
  for (int i = 0; i < 5; ++i) r *= (4.0 - v2 * r * r * r) * (1.0 / 3.0);
  return r;
}

/// True where any of the first `count` lanes is not above zero (NaN counts as not above).
inline bool any_not_positive(Lane v, int count) {
  for (int l = 0; l < count; ++l)
    if (!(v[l] > 0)) return true;
  return false;
}

}  // namespace genio::lanes
