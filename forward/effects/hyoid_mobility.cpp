#include "forward/effects/hyoid_mobility.hpp"

namespace genio {
namespace {

constexpr double least_compliance = 1e-8;  // [m/N]

/// Spring constants along x, y and z [N/m].
Vec3 springs(EffectParameters p) { return {p[1], p[1], 1 / (p[0] + least_compliance)}; }

}  // namespace

HyoidMobility::HyoidMobility(const std::vector<int>& nodes, const Positions& rest,
                             double compliance_z, double stiffness_xy, double mass)
    : node_(nodes.at(0)),
      rest_(node_position(rest, nodes.at(0))),
      info_{{{"compliance_z", "m/N", compliance_z, 0, 1, 0, false, false, 2e-3},
             {"stiffness_xy", "N/m", stiffness_xy, 0, 1e5, 0, false, false, 500},
             {"mass", "kg", mass, 0, 1, mass}}} {}

double HyoidMobility::energy(const Positions& x, EffectParameters p) const {
  return 0.5 * springs(p).dot(displacement(x).cwiseAbs2());
}

void HyoidMobility::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  f.segment<3>(3 * node_) -= springs(p).cwiseProduct(displacement(x));
}

void HyoidMobility::add_stiffness(const Positions&, EffectParameters p, Stiffness& k) const {
  k.add(node_, node_, springs(p).asDiagonal());
}

void HyoidMobility::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                         Forces& df) const {
  const Vec3 u = displacement(x);
  const double kz = springs(p)[2];
  if (k == 0) df[3 * node_ + 2] += kz * kz * u[2];
  if (k == 1) df.segment<2>(3 * node_) -= u.head<2>();
}

}  // namespace genio
