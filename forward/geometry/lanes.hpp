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

/// Cofactors of a 3x3 matrix: its inverse transposed times its determinant.
inline void cofactors(const Lane (&f)[3][3], Lane (&c)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c[i][j] = f[i1][j1] * f[i2][j2] - f[i1][j2] * f[i2][j1];
    }
}

/// True where any of the first `count` lanes is not above zero (NaN counts as not above).
inline bool any_not_positive(Lane v, int count) {
  for (int l = 0; l < count; ++l)
    if (!(v[l] > 0)) return true;
  return false;
}

}  // namespace genio::lanes
