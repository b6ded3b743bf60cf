#include "forward/effects/surroundings/contact.hpp"

#include <algorithm>

namespace genio {
namespace {

constexpr double reach = 4e-3;  // [m]
constexpr int jaw_angle = 1;    // borrowed, as is the slide after it

EffectParameters jaw(EffectParameters p) { return p.subspan(jaw_angle); }

}  // namespace

Contact::Contact(std::string name, std::shared_ptr<const ContactSurface> surface, double stiffness)
    : name_(std::move(name)),
      surface_(std::move(surface)),
      info_{{{.name = "stiffness",
              .unit = "Pa/m",
              .value = stiffness,
              .lower = 0,
              .upper = 1e12,
              .penalty = true}}} {}

double Contact::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  each_touching(*surface_, x, jaw(p), [&](const ContactNode& c, const auto&, double depth) {
    e += p[0] * c.area * contact_spring(depth).value;
  });
  return e;
}

void Contact::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  each_touching(*surface_, x, jaw(p), [&](const ContactNode& c, const auto& surface, double depth) {
    f.segment<3>(3 * c.node) += p[0] * c.area * contact_spring(depth).slope *
                                surface.sample(node_position(x, c.node)).gradient;
  });
}

void Contact::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  add_step_stiffness(x, {x, Vector::Zero(x.size()), {}}, p, k);
}

void Contact::add_step_stiffness(const Positions& x, const LinearStep& led, EffectParameters p,
                                 Stiffness& k) const {
  each_touching(*surface_, x, jaw(p), [&](const ContactNode& c, const auto& surface, double depth) {
    const auto s = surface.sample(node_position(x, c.node));
    const auto before = surface.sample(node_position(led.from, c.node));
    const SoftSpring spring = contact_spring(depth),
                     was = contact_spring(c.clearance - before.value);
    const double slope = std::max(
        0.0, was.slope - was.curvature * before.gradient.dot(node_position(led.step, c.node)));
    k.add(c.node, c.node,
          p[0] * c.area *
              (spring.curvature * s.gradient * s.gradient.transpose() - slope * s.hessian));
  });
}

void Contact::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                   Forces& df) const {
  each_touching(*surface_, x, jaw(p), [&](const ContactNode& c, const auto& surface, double depth) {
    const SoftSpring spring = contact_spring(depth);
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

double Contact::step_limit(const Positions& x, const Positions& along, EffectParameters p) const {
  const PlacedSurface surface(*surface_, jaw(p));
  double t = 1.0;
  for (const auto& c : surface_->nodes) {
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
  each_touching(*surface_, x, jaw(p), [&](const ContactNode&, const auto&, double depth) {
    deepest = std::max(deepest, depth);
  });
  return deepest;
}

}  // namespace genio
