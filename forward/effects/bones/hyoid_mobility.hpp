#pragma once
#include <array>
#include <vector>

#include "forward/effects/effect.hpp"

namespace genio {

/// The hyoid on springs instead of a horizontal plane: one rigid body that translates.
///
/// E = u_z^2 / (2 (compliance_z + 1e-8 m/N)) + stiffness_xy (u_x^2 + u_y^2) / 2, u its
/// displacement; with no compliance it stays in its plane to 10 nm a newton. Its nodes share the
/// springs, so that half a tongue has half of them. Its mass counts in dynamics. Parameters:
/// compliance_z [m/N], stiffness_xy [N/m], mass [kg].
class HyoidMobility final : public Effect {
 public:
  /// `nodes`: the body's, each with its share of springs and mass (together 1).
  HyoidMobility(std::vector<int> nodes, std::vector<double> shares, const Positions& rest,
                double compliance_z, double stiffness_xy, double mass);

  std::string_view name() const override { return "hyoid_mobility"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;
  void add_mass(EffectParameters p, Vector& mass) const override;

 private:
  Vec3 displacement(const Positions& x, size_t i) const {
    return node_position(x, nodes_[i]) - rest_[i];
  }

  std::vector<int> nodes_;
  std::vector<double> shares_;
  std::vector<Vec3> rest_;
  std::array<ParameterInfo, 3> info_;
};

}  // namespace genio
