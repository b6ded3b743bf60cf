#pragma once
// Energies of the lengths of fibre segments.

#include <Eigen/Dense>

#include "forward/algebra/stiffness.hpp"
#include "forward/base/parameter_name.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// A function of a segment's length L: value, derivative over L, second derivative.
struct LengthEnergy {
  double value, slope_over_length, curvature;
};

/// Tension 1: value L, but below the segment's short_length l, where tension fades:
/// l (3/8 + 3/4 s^2 - 1/8 s^4), s = L / l, which joins L with two continuous derivatives.
LengthEnergy unit_tension(const FibreSegment& segment, double length);

inline Vec3 span(const FibreSegment& s, const Positions& x) {
  return s.end.position(x) - s.start.position(x);
}

/// Adds the force of scale * psi(segment, L), psi giving a LengthEnergy, over a muscle's segments.
template <class Psi>
void add_segment_force(const std::vector<FibreSegment>& segments, const Positions& x, double scale,
                       Psi psi, Forces& f) {
  for (const auto& s : segments) {
    const Vec3 d = span(s, x);
    const Vec3 pull = scale * s.share * psi(s, d.norm()).slope_over_length * d;
    if (s.start.node >= 0) f.segment<3>(3 * s.start.node) += pull;
    if (s.end.node >= 0) f.segment<3>(3 * s.end.node) -= pull;
  }
}

template <class Psi>
double segment_energy(const std::vector<FibreSegment>& segments, const Positions& x, Psi psi) {
  double e = 0;
  for (const auto& s : segments) e += s.share * psi(s, span(s, x).norm()).value;
  return e;
}

/// Adds a 3x3 block between the two ends of a segment.
inline void add_between(const FibreSegment& s, const Mat3& block, Stiffness& k) {
  const int a = s.start.node, b = s.end.node;
  if (a >= 0) k.add(a, a, block);
  if (b >= 0) k.add(b, b, block);
  if (a >= 0 && b >= 0) k.add(a, b, -block);
}

template <class Psi>
void add_segment_stiffness(const std::vector<FibreSegment>& segments, const Positions& x,
                           double scale, Psi psi, Stiffness& k) {
  for (const auto& s : segments) {
    const Vec3 d = span(s, x);
    const LengthEnergy e = psi(s, d.norm());
    const Vec3 t = d.normalized();  // 0 for a segment of no length
    const Mat3 along = t * t.transpose();
    add_between(
        s,
        scale * s.share * (e.curvature * along + e.slope_over_length * (Mat3::Identity() - along)),
        k);
  }
}

/// Node pairs that the segments of these muscles join.
std::vector<std::pair<int, int>> segment_couplings(const std::vector<Muscle>& muscles);

/// The parameter names of the muscles' commands: "muscles.GGP_L", ...
std::vector<ParameterName> command_names(const std::vector<Muscle>& muscles);

}  // namespace genio
