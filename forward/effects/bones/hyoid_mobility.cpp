#include "forward/effects/bones/hyoid_mobility.hpp"

namespace genio {
namespace {

constexpr double least_compliance = 1e-8;  // [m/N]

/// Spring constants along x, y and z [N/m].
Vec3 springs(EffectParameters p) { return {p[1], p[1], 1 / (p[0] + least_compliance)}; }

}  // namespace

HyoidMobility::HyoidMobility(std::vector<int> nodes, std::vector<double> shares,
                             const Positions& rest, double compliance_z, double stiffness_xy,
                             double mass)
    : nodes_(std::move(nodes)),
      shares_(std::move(shares)),
      info_{{{"compliance_z", "m/N", compliance_z, 0, 1, 0, false, false, 2e-3},
             {"stiffness_xy", "N/m", stiffness_xy, 0, 1e5, 0, false, false, 500},
             {"mass", "kg", mass, 0, 1, mass}}} {
  for (int a : nodes_) rest_.push_back(node_position(rest, a));
}

double HyoidMobility::energy(const Positions& x, EffectParameters p) const {
  double sum = 0;
  for (size_t i = 0; i < nodes_.size(); ++i)
    sum += 0.5 * shares_[i] * springs(p).dot(displacement(x, i).cwiseAbs2());
  return sum;
}

void HyoidMobility::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  for (size_t i = 0; i < nodes_.size(); ++i)
    f.segment<3>(3 * nodes_[i]) -= shares_[i] * springs(p).cwiseProduct(displacement(x, i));
}

void HyoidMobility::add_stiffness(const Positions&, EffectParameters p, Stiffness& k) const {
  for (size_t i = 0; i < nodes_.size(); ++i)
    k.add(nodes_[i], nodes_[i], (shares_[i] * springs(p)).asDiagonal());
}

void HyoidMobility::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                         Forces& df) const {
  const double kz = springs(p)[2];
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Vec3 u = shares_[i] * displacement(x, i);
    if (k == 0) df[3 * nodes_[i] + 2] += kz * kz * u[2];
    if (k == 1) df.segment<2>(3 * nodes_[i]) -= u.head<2>();
  }
}

void HyoidMobility::add_mass(EffectParameters p, Vector& mass) const {
  for (size_t i = 0; i < nodes_.size(); ++i) mass[nodes_[i]] += shares_[i] * p[2];
}

}  // namespace genio
