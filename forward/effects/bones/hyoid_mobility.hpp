#pragma once
#include <array>
#include <vector>

#include "forward/effects/kind.hpp"

namespace genio {

/// The nodes that are the hyoid, each with its share of what is said of the body (together 1; half
/// a tongue has half the shares).
struct HyoidBody {
  std::vector<int> nodes;
  std::vector<double> shares;
};

/// The hyoid on springs instead of a horizontal plane: one rigid body that translates.
///
/// E = u_z^2 / (2 (compliance_z + 1e-8 m/N)) + stiffness_xy (u_x^2 + u_y^2) / 2, u its
/// displacement; with no compliance it stays in its plane to 10 nm a newton. Its nodes share the
/// springs. Parameters: compliance_z [m/N], stiffness_xy [N/m].
class HyoidMobility final : public Potential {
 public:
  HyoidMobility(HyoidBody body, const Positions& rest, double compliance_z, double stiffness_xy);

  std::string_view name() const override { return "hyoid_mobility"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  Vec3 displacement(const Positions& x, size_t i) const {
    return node_position(x, body_.nodes[i]) - rest_[i];
  }

  HyoidBody body_;
  std::vector<Vec3> rest_;
  std::array<ParameterInfo, 2> info_;
};

/// The hyoid's mass, which counts in dynamics. Parameter: mass [kg].
class HyoidMass final : public Inertia {
 public:
  HyoidMass(HyoidBody body, double mass);

  std::string_view name() const override { return "hyoid_mobility"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  void add_mass(EffectParameters p, Vector& mass) const override;

 private:
  HyoidBody body_;
  std::array<ParameterInfo, 1> info_;
};

EffectKind hyoid_mobility_kind();

}  // namespace genio
