#pragma once
#include <array>
#include <memory>
#include <optional>

#include "forward/effects/bones/jaw_motion.hpp"
#include "forward/effects/effect.hpp"
#include "forward/geometry/distance_field.hpp"

namespace genio {

/// A surface node that may touch.
struct ContactNode {
  int node;
  double area;       ///< surface it stands for [m^2]
  double clearance;  ///< subtracted from the distance: below 0 where the node overlaps at rest [m]
};

/// Penalty contact with a rigid surface.
///
/// E = sum_a A_a k phi(g_a), g_a = distance(x_a) - clearance_a, phi(g) = 0 for g >= 0. The spring
/// stiffens over the first `soft_depth` (phi'' rises linearly from 0 to 1) and is linear beyond,
/// so force and stiffness are continuous. A surface that belongs to an opening jaw moves with it.
/// In dynamics the spring is damped (the seed model's; after Hunt & Crossley 1975): the normal
/// force is k phi' (1 + damping * rate of the depth), by the depth that the spring has. Parameters:
/// stiffness k [Pa/m], pressure per depth; damping [s/m].
class Contact final : public Effect {
 public:
  static constexpr double soft_depth = 5e-5;  ///< [m]

  Contact(std::string name, std::shared_ptr<const DistanceField> field,
          std::vector<ContactNode> nodes, double stiffness, double damping,
          std::optional<Vec3> jaw_hinge = {});

  std::string_view name() const override { return name_; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  /// The jaw's motion, where the surface belongs to it.
  std::vector<std::string> borrows() const override;
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  /// The surface's curvature enters with the force that the linearisation predicted for x: a
  /// straight step overshoots, and the force of its deep penetration is no guide.
  void add_step_stiffness(const Positions& x, const LinearStep& led, EffectParameters p,
                          Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;
  /// No node goes deeper than `reach` in one step, unless it is deeper already.
  double step_limit(const Positions& x, const Positions& along, EffectParameters p) const override;
  void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                         Forces& f) const override;
  void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                   Stiffness& c) const override;
  void add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                               const Matrix& along, Stiffness& scratch, Matrix& df) const override;
  void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p, int k,
                                    Forces& df) const override;
  /// Signed distance of a point from the surface as it lies at rest, positive on the tongue's side
  /// [m].
  double distance(const Vec3& point) const { return field_->value(point); }
  /// Deepest penetration in the shape `x` beyond the overlap at rest [m], >= 0.
  double max_penetration(const Positions& x, EffectParameters p) const;

 private:
  class Surface;  // the field where the parameters put it
  template <class Act>
  void each_touching(const Positions& x, EffectParameters p, Act act) const;

  std::string name_;
  std::shared_ptr<const DistanceField> field_;
  std::vector<ContactNode> nodes_;
  std::optional<Vec3> jaw_hinge_;
  std::array<ParameterInfo, 2> info_;
};

}  // namespace genio
