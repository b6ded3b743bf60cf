#pragma once
#include <array>

#include "forward/effects/bones/jaw_motion.hpp"
#include "forward/effects/kind.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// The jaw opens: every node that is fixed to it is led along its JawMotion.
///
/// E = 1/2 sum_a k_a |x_a - X_a(angle, slide)|^2 with k_a = 2.5e4 N/m for every element at node a
/// (half of them on the plane of half a tongue), stiff enough to stay within some micrometres of
/// the path, so that the path is a parameter like any other. Parameters: angle [deg], slide [m].
class JawOpening final : public Potential {
 public:
  JawOpening(std::vector<int> nodes, const HexMesh& mesh, const JawMotion& motion);

  std::string_view name() const override { return "jaw_opening"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  JawMotion motion(EffectParameters p) const { return {hinge_, p[0], p[1]}; }

  std::vector<int> nodes_;
  std::vector<double> springs_;  // of each [N/m]
  Positions rest_;
  Vec3 hinge_;
  std::array<ParameterInfo, 2> info_;
};

/// Where the jaw turns, from the jaw_opening table; nothing where the jaw does not open [m].
std::optional<Vec3> opening_hinge(const Anatomy& anatomy);

EffectKind jaw_opening_kind();

}  // namespace genio
