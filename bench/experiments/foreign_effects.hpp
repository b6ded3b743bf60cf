#pragma once
// Effects that no library has, to see what the discrepancy workflow says of them.

#include <array>

#include "forward/effects/potential.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio::bench {

/// A band of tissue that tethers a patch of the surface to a fixed point and pulls once it is taut:
/// E = stiffness/2 (|m - anchor| - slack)^2, m the patch's mean. Parameter: stiffness [N/m].
class Tether final : public Potential {
 public:
  Tether(const HexMesh& mesh, const Vec3& patch, double radius, const Vec3& anchor, double slack,
         double stiffness);
  std::string_view name() const override { return "tether"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;
  std::vector<std::pair<int, int>> couplings() const override;

 private:
  Vec3 arm(const Positions& x) const;

  std::vector<std::pair<int, double>> nodes_;
  Vec3 anchor_;
  double slack_;
  std::array<ParameterInfo, 1> info_;
};

/// The same mesh with a lump of `height` [m] grown on its surface about `at`, over `radius` [m].
HexMesh with_lump(HexMesh mesh, const Vec3& at, const Vec3& outward, double radius, double height);

}  // namespace genio::bench
