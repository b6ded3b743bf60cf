#pragma once
// The Yeoh law on the isochoric part of the deformation, for doubles or lanes of doubles.

namespace genio {

/// W = a10 (I - 3) + a20 (I - 3)^2 + a30 (I - 3)^3 with I = J^(-2/3) tr(F^T F), the first invariant
/// of the volume-preserving part of F (Yeoh 1993; split after Flory 1961). [Pa]
template <class T>
struct Yeoh {
  T a10, a20, a30;

  T energy_density(T i1_minus_3) const {
    return i1_minus_3 * (a10 + i1_minus_3 * (a20 + i1_minus_3 * a30));
  }
  /// dW/dI
  T slope(T i1_minus_3) const { return a10 + i1_minus_3 * (2.0 * a20 + i1_minus_3 * (3.0 * a30)); }
  /// d2W/dI2
  T curvature(T i1_minus_3) const { return 2.0 * a20 + 6.0 * a30 * i1_minus_3; }
};

}  // namespace genio
