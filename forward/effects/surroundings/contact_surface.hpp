#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "forward/base/parameter_name.hpp"
#include "forward/effects/bones/jaw_motion.hpp"
#include "forward/effects/parameter.hpp"
#include "forward/geometry/distance_field.hpp"
#include "forward/tissue/soft_spring.hpp"

namespace genio {

/// A surface node that may touch.
struct ContactNode {
  int node;
  double area;       ///< surface it stands for [m^2]
  double clearance;  ///< subtracted from the distance: below 0 where the node overlaps at rest [m]
};

/// A rigid surface at rest and the nodes that may touch it.
struct ContactSurface {
  std::shared_ptr<const DistanceField> field;
  std::vector<ContactNode> nodes;
  std::optional<Vec3> jaw_hinge = {};  ///< set where the surface belongs to an opening jaw [m]

  /// The jaw's motion, where the surface belongs to it.
  std::vector<ParameterName> borrows() const;
};

/// A contact surface where the jaw's angle [deg] and slide [m] put it.
class PlacedSurface {
 public:
  /// `jaw`: the values that the surface borrows, angle and slide or nothing.
  PlacedSurface(const ContactSurface& surface, EffectParameters jaw);

  /// Signed distance [m], positive on the tongue's side.
  double value(const Vec3& x) const { return field_.value(moved_ ? jaw_.back(x) : x); }
  DistanceSample sample(const Vec3& x) const;
  /// How distance and its gradient change with the angle (or the slide) at x.
  std::pair<double, Vec3> by_jaw(const Vec3& x, bool angle) const;

 private:
  const DistanceField& field_;
  JawMotion jaw_;
  bool moved_ = false;
  Mat3 turn_ = Mat3::Identity();
};

/// The contact's spring at a depth [m].
inline SoftSpring contact_spring(double depth) {
  constexpr double soft_depth = 5e-5;  // [m]
  return {depth, soft_depth};
}

/// act(node, placed surface, depth) for every node below the surface.
template <class Act>
void each_touching(const ContactSurface& surface, const Positions& x, EffectParameters jaw,
                   Act act) {
  const PlacedSurface placed(surface, jaw);
  for (const ContactNode& c : surface.nodes) {
    const double depth = c.clearance - placed.value(node_position(x, c.node));
    if (depth > 0) act(c, placed, depth);
  }
}

}  // namespace genio
