#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "forward/algebra/stiffness.hpp"
#include "forward/base/parameter_name.hpp"
#include "forward/effects/bones/jaw_motion.hpp"
#include "forward/effects/parameter.hpp"
#include "forward/effects/surroundings/contact_faces.hpp"
#include "forward/geometry/surfaces/distance_rates.hpp"
#include "forward/tissue/soft_spring.hpp"

namespace genio {

/// A point below the surface in the shape at hand.
struct TouchingPoint {
  const ContactPoint* point;
  Vec3 at;       ///< [m]
  double depth;  ///< [m], > 0
};

/// A rigid bone at rest and the tongue's faces that may touch it.
struct ContactSurface {
  std::shared_ptr<const ContactFaces> touchable;
  std::optional<Vec3> jaw_hinge = {};  ///< set where the surface belongs to an opening jaw [m]

  /// The jaw's motion, where the surface belongs to it.
  std::vector<ParameterName> borrows() const;
};

/// A contact surface where the jaw's angle [deg] and slide [m] put it.
class PlacedSurface {
 public:
  /// `jaw`: the values that the surface borrows, angle and slide or nothing.
  PlacedSurface(const ContactSurface& surface, EffectParameters jaw);

  /// Signed distance where it may touch, positive on the tongue's side; else perhaps only some
  /// larger number [m].
  double value_if_touching(const Vec3& x) const { return field_.value_if_touching(local(x)); }
  DistanceSample sample(const Vec3& x) const;
  /// How distance and gradient change with the bone's own shape.
  DistanceRates::Rates rates(DistanceRates& rates, const Vec3& x) const;
  /// The distance to within 2 mm, without filling in what is fine [m].
  double rough(const Vec3& x) const { return field_.rough(local(x)); }
  /// A lower bound of the value within a radius about x [m].
  double at_least(const Vec3& x, double radius) const { return field_.at_least(local(x), radius); }
  /// How distance and its gradient change with the angle (or the slide) at x.
  std::pair<double, Vec3> by_jaw(const Vec3& x, bool angle) const;

 private:
  Vec3 local(const Vec3& x) const { return moved_ ? jaw_.back(x) : x; }

  const DistanceField& field_;
  JawMotion jaw_;
  bool moved_ = false;
  Mat3 turn_ = Mat3::Identity();
};

/// The contact's spring at a depth [m]: it sets in softly over 0.055 mm, and hardens 150 times over
/// as much again, as the whole load of a tongue may rest on an edge.
inline SoftSpring contact_spring(double depth) {
  constexpr double soft_depth = 5.5e-5, harder = 150;  // [m], -
  const SoftSpring first(depth, soft_depth);
  if (depth <= soft_depth) return first;
  const SoftSpring second(depth - soft_depth, soft_depth);
  return {first.value + harder * second.value, first.slope + harder * second.slope,
          first.curvature + harder * second.curvature};
}

/// A face that touches, and its touching points.
struct TouchingFace {
  const ContactFace* face;
  std::vector<TouchingPoint> points;
};

/// Every face that touches in the shape `x`. Energy, force and stiffness are asked for at the same
/// shape one after the other, so each thread remembers its latest searches.
const std::vector<TouchingFace>& find_touching(const ContactSurface& surface, const Positions& x,
                                               EffectParameters jaw);

/// act(face, its touching points, placed surface) for every face that touches.
template <class Act>
void each_touching_face(const ContactSurface& surface, const Positions& x, EffectParameters jaw,
                        Act act) {
  const PlacedSurface placed(surface, jaw);
  for (const TouchingFace& t : find_touching(surface, x, jaw)) act(*t.face, t.points, placed);
}

/// act(face's nodes, touching point, placed surface) for every point below the surface.
template <class Act>
void each_touching(const ContactSurface& surface, const Positions& x, EffectParameters jaw,
                   Act act) {
  each_touching_face(surface, x, jaw,
                     [&](const ContactFace& face, const auto& points, const PlacedSurface& placed) {
                       for (const TouchingPoint& t : points) act(face.nodes, t, placed);
                     });
}

/// Adds a point's force to the face's nodes.
inline void spread(const Quad& nodes, const ContactPoint& point, const Vec3& force, Forces& f) {
  for (int a = 0; a < 4; ++a) f.segment<3>(3 * nodes[size_t(a)]) += point.weight[size_t(a)] * force;
}

/// Gathers points' stiffness over a face, so that each pair of nodes is looked up once.
class FaceStiffness {
 public:
  void add(const ContactPoint& point, const Mat3& k);
  void add_to(const Quad& nodes, Stiffness& k) const;

 private:
  std::array<Mat3, 10> pair_ = [] {
    std::array<Mat3, 10> z;
    z.fill(Mat3::Zero());
    return z;
  }();
};

}  // namespace genio
