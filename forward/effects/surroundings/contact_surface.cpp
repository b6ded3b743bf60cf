#include "forward/effects/surroundings/contact_surface.hpp"

namespace genio {

std::vector<ParameterName> ContactSurface::borrows() const {
  if (!jaw_hinge) return {};
  return {{"jaw_opening", "angle"}, {"jaw_opening", "slide"}};
}

PlacedSurface::PlacedSurface(const ContactSurface& surface, EffectParameters jaw)
    : field_(*surface.field) {
  if (!surface.jaw_hinge) return;
  jaw_ = JawMotion{*surface.jaw_hinge, jaw[0], jaw[1]};
  moved_ = jaw_.angle != 0 || jaw_.slide != 0;
  turn_ = jaw_.turn();
}

DistanceSample PlacedSurface::sample(const Vec3& x) const {
  if (!moved_) return field_.sample(x);
  DistanceSample s = field_.sample(jaw_.back(x));
  s.gradient = turn_ * s.gradient;
  s.hessian = turn_ * s.hessian * turn_.transpose();
  return s;
}

std::pair<double, Vec3> PlacedSurface::by_jaw(const Vec3& x, bool angle) const {
  const DistanceSample s = field_.sample(jaw_.back(x));
  const Vec3 local = angle ? jaw_.back_by_angle(x) : jaw_.back_by_slide();
  Vec3 gradient = turn_ * (s.hessian * local);
  if (angle) gradient += jaw_.turn_by_angle() * s.gradient;
  return {s.gradient.dot(local), gradient};
}

}  // namespace genio
