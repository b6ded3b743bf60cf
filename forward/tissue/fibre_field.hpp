#pragma once
// Energies of the stretch of tissue along a direction, at points inside the elements.

#include <array>
#include <cmath>
#include <vector>

#include "forward/algebra/stiffness.hpp"

namespace genio {

/// A Gauss point and a material direction a0: F a0 = sum_a rate_a x_a.
struct FibreSample {
  std::array<int, 8> node;
  std::array<double, 8> rate;  ///< dN_a/dX . a0 [1/m]
  double weight;               ///< [m^3] times a share

  Vec3 stretched(const Positions& x) const {
    Vec3 y = Vec3::Zero();
    for (int a = 0; a < 8; ++a) y += rate[a] * node_position(x, node[a]);
    return y;
  }
};

/// The sample of Gauss point `q` of an element along the unit vector `direction`; `share`
/// multiplies its volume.
FibreSample fibre_sample(const HexMesh& mesh, int element, int q, const Vec3& direction,
                         double share);
/// Place of Gauss point `q` at rest [m].
Vec3 gauss_point(const HexMesh& mesh, int element, int q);

/// A function of I4 = |F a0|^2 with its derivatives.
struct StretchEnergy {
  double value, slope, curvature;
};

/// sum of weight psi(I4) [J]; psi(I4) gives a StretchEnergy [Pa].
template <class Psi>
double field_energy(const std::vector<FibreSample>& samples, const Positions& x, Psi psi) {
  double e = 0;
  for (const auto& s : samples) e += s.weight * psi(s.stretched(x).squaredNorm()).value;
  return e;
}

/// Adds minus its derivative [N].
template <class Psi>
void add_field_force(const std::vector<FibreSample>& samples, const Positions& x, Psi psi,
                     Forces& f) {
  for (const auto& s : samples) {
    const Vec3 y = s.stretched(x);
    const Vec3 pull = 2 * s.weight * psi(y.squaredNorm()).slope * y;
    for (int a = 0; a < 8; ++a) f.segment<3>(3 * s.node[a]) -= s.rate[a] * pull;
  }
}

/// Adds its second derivative [N/m].
template <class Psi>
void add_field_stiffness(const std::vector<FibreSample>& samples, const Positions& x, Psi psi,
                         Stiffness& k) {
  for (const auto& s : samples) {
    const Vec3 y = s.stretched(x);
    const StretchEnergy e = psi(y.squaredNorm());
    if (e.slope == 0 && e.curvature == 0) continue;
    const Mat3 m =
        s.weight * (2 * e.slope * Mat3::Identity() + 4 * e.curvature * y * y.transpose());
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b <= a; ++b) k.add(s.node[a], s.node[b], s.rate[a] * s.rate[b] * m);
  }
}

}  // namespace genio
