#include "forward/effects/surroundings/contact.hpp"

#include <algorithm>

#include "forward/tissue/soft_spring.hpp"

namespace genio {
namespace {

constexpr double reach = 4e-3;               // [m]
constexpr int jaw_angle = 2, jaw_slide = 3;  // borrowed

}  // namespace

/// The distance field, turned and shifted with the jaw where it belongs to one.
class Contact::Surface {
 public:
  Surface(const Contact& contact, EffectParameters p) : field_(*contact.field_) {
    if (!contact.jaw_hinge_) return;
    jaw_ = JawMotion{*contact.jaw_hinge_, p[jaw_angle], p[jaw_slide]};
    moved_ = jaw_.angle != 0 || jaw_.slide != 0;
    turn_ = jaw_.turn();
  }
  double value(const Vec3& x) const { return field_.value(moved_ ? jaw_.back(x) : x); }
  DistanceSample sample(const Vec3& x) const {
    if (!moved_) return field_.sample(x);
    DistanceSample s = field_.sample(jaw_.back(x));
    s.gradient = turn_ * s.gradient;
    s.hessian = turn_ * s.hessian * turn_.transpose();
    return s;
  }
  /// How distance and its gradient change with the angle (or the slide) at x.
  std::pair<double, Vec3> by_jaw(const Vec3& x, bool angle) const {
    const DistanceSample s = field_.sample(jaw_.back(x));
    const Vec3 local = angle ? jaw_.back_by_angle(x) : jaw_.back_by_slide();
    Vec3 gradient = turn_ * (s.hessian * local);
    if (angle) gradient += jaw_.turn_by_angle() * s.gradient;
    return {s.gradient.dot(local), gradient};
  }

 private:
  const DistanceField& field_;
  JawMotion jaw_;
  bool moved_ = false;
  Mat3 turn_ = Mat3::Identity();
};

Contact::Contact(std::string name, std::shared_ptr<const DistanceField> field,
                 std::vector<ContactNode> nodes, double stiffness, double damping,
                 std::optional<Vec3> jaw_hinge)
    : name_(std::move(name)),
      field_(std::move(field)),
      nodes_(std::move(nodes)),
      jaw_hinge_(jaw_hinge),
      info_{{{"stiffness", "Pa/m", stiffness, 0, 1e12, 0, false, true, 2e8},
             {"damping", "s/m", damping, 0, 1e4, 0}}} {}

std::vector<std::string> Contact::borrows() const {
  if (!jaw_hinge_) return {};
  return {"jaw_opening.angle", "jaw_opening.slide"};
}

/// act(node, surface, depth) for every node below the surface.
template <class Act>
void Contact::each_touching(const Positions& x, EffectParameters p, Act act) const {
  const Surface surface(*this, p);
  for (const auto& c : nodes_) {
    const double depth = c.clearance - surface.value(node_position(x, c.node));
    if (depth > 0) act(c, surface, depth);
  }
}

double Contact::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  each_touching(x, p, [&](const ContactNode& c, const Surface&, double depth) {
    e += p[0] * c.area * SoftSpring(depth, soft_depth).value;
  });
  return e;
}

void Contact::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  each_touching(x, p, [&](const ContactNode& c, const Surface& surface, double depth) {
    f.segment<3>(3 * c.node) += p[0] * c.area * SoftSpring(depth, soft_depth).slope *
                                surface.sample(node_position(x, c.node)).gradient;
  });
}

void Contact::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  add_step_stiffness(x, {x, Vector::Zero(x.size()), {}}, p, k);
}

void Contact::add_step_stiffness(const Positions& x, const LinearStep& led, EffectParameters p,
                                 Stiffness& k) const {
  each_touching(x, p, [&](const ContactNode& c, const Surface& surface, double depth) {
    const auto s = surface.sample(node_position(x, c.node));
    const auto before = surface.sample(node_position(led.from, c.node));
    const SoftSpring spring(depth, soft_depth), was(c.clearance - before.value, soft_depth);
    const double slope = std::max(
        0.0, was.slope - was.curvature * before.gradient.dot(node_position(led.step, c.node)));
    k.add(c.node, c.node,
          p[0] * c.area *
              (spring.curvature * s.gradient * s.gradient.transpose() - slope * s.hessian));
  });
}

void Contact::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                   Forces& df) const {
  if (k == 1) return;  // damping does no work in statics
  each_touching(x, p, [&](const ContactNode& c, const Surface& surface, double depth) {
    const SoftSpring spring(depth, soft_depth);
    const Vec3 at = node_position(x, c.node), normal = surface.sample(at).gradient;
    if (k == 0) {
      df.segment<3>(3 * c.node) += c.area * spring.slope * normal;
      return;
    }
    const auto [distance, gradient] = surface.by_jaw(at, k == jaw_angle);
    df.segment<3>(3 * c.node) +=
        p[0] * c.area * (spring.slope * gradient - spring.curvature * distance * normal);
  });
}

void Contact::add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                                Forces& f) const {
  if (p[1] == 0) return;
  each_touching(x, p, [&](const ContactNode& c, const Surface& surface, double depth) {
    const Vec3 normal = surface.sample(node_position(x, c.node)).gradient;
    f.segment<3>(3 * c.node) -= p[0] * p[1] * c.area * SoftSpring(depth, soft_depth).slope *
                                normal.dot(node_position(v, c.node)) * normal;
  });
}

void Contact::add_damping(const Positions& x, const Vector&, EffectParameters p,
                          Stiffness& damping) const {
  if (p[1] == 0) return;
  each_touching(x, p, [&](const ContactNode& c, const Surface& surface, double depth) {
    const Vec3 normal = surface.sample(node_position(x, c.node)).gradient;
    damping.add(
        c.node, c.node,
        p[0] * p[1] * c.area * SoftSpring(depth, soft_depth).slope * normal * normal.transpose());
  });
}

void Contact::add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                                      const Matrix& along, Stiffness&, Matrix& df) const {
  if (p[1] == 0) return;
  each_touching(x, p, [&](const ContactNode& c, const Surface& surface, double depth) {
    const auto s = surface.sample(node_position(x, c.node));
    const SoftSpring spring(depth, soft_depth);
    const Vec3 &n = s.gradient, speed = node_position(v, c.node);
    const Mat3 slope =
        -spring.curvature * n.dot(speed) * n * n.transpose() +
        spring.slope * (n * (s.hessian * speed).transpose() + n.dot(speed) * s.hessian);
    df.middleRows<3>(3 * c.node) -= p[0] * p[1] * c.area * slope * along.middleRows<3>(3 * c.node);
  });
}

void Contact::add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p,
                                           int k, Forces& df) const {
  if (k <= 1) {  // linear in stiffness and in damping
    const double unit[] = {k == 0 ? 1 : p[0], k == 1 ? 1 : p[1], jaw_hinge_ ? p[jaw_angle] : 0,
                           jaw_hinge_ ? p[jaw_slide] : 0};
    add_viscous_force(x, v, unit, df);
    return;
  }
  each_touching(x, p, [&](const ContactNode& c, const Surface& surface, double depth) {
    const SoftSpring spring(depth, soft_depth);
    const Vec3 at = node_position(x, c.node), normal = surface.sample(at).gradient;
    const Vec3 speed = node_position(v, c.node);
    const auto [distance, gradient] = surface.by_jaw(at, k == jaw_angle);
    df.segment<3>(3 * c.node) -=
        p[0] * p[1] * c.area *
        (-spring.curvature * distance * normal.dot(speed) * normal +
         spring.slope * (gradient.dot(speed) * normal + normal.dot(speed) * gradient));
  });
}

double Contact::step_limit(const Positions& x, const Positions& along, EffectParameters p) const {
  const Surface surface(*this, p);
  double t = 1.0;
  for (const auto& c : nodes_) {
    const auto gap_at = [&](double s) {
      return surface.value(node_position(x, c.node) + s * node_position(along, c.node)) -
             c.clearance;
    };
    const double deepest = std::min(-reach, 2 * gap_at(0));
    while (t > 1e-3 && gap_at(t) < deepest) t *= 0.7;
  }
  return t;
}

double Contact::max_penetration(const Positions& x, EffectParameters p) const {
  double deepest = 0;
  each_touching(x, p, [&](const ContactNode&, const Surface&, double depth) {
    deepest = std::max(deepest, depth);
  });
  return deepest;
}

}  // namespace genio
