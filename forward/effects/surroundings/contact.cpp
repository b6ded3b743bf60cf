#include "forward/effects/surroundings/contact.hpp"

#include <algorithm>

#include "forward/effects/surroundings/contact_rates.hpp"

namespace genio {
namespace {

constexpr double reach = 4e-3;  // [m]
constexpr int jaw_angle = 1;    // borrowed, as is the slide after it

EffectParameters jaw(EffectParameters p) { return p.subspan(jaw_angle); }

}  // namespace

Contact::Contact(std::string name, std::shared_ptr<const ContactSurface> surface, double stiffness,
                 std::vector<Vec3> AnatomyMode::*of_bone)
    : name_(std::move(name)),
      surface_(std::move(surface)),
      info_{{{.name = "stiffness",
              .unit = "Pa/m",
              .value = stiffness,
              .lower = 0,
              .upper = 1e12,
              .penalty = true}}},
      of_bone_(of_bone) {}

double Contact::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  each_touching(*surface_, x, jaw(p), [&](const Quad&, const TouchingPoint& t, const auto&) {
    e += p[0] * t.point->area * contact_spring(t.depth).value;
  });
  return e;
}

void Contact::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  each_touching(*surface_, x, jaw(p),
                [&](const Quad& nodes, const TouchingPoint& t, const PlacedSurface& placed) {
                  const double pressure = p[0] * contact_spring(t.depth).slope;
                  spread(nodes, *t.point, pressure * t.point->area * placed.sample(t.at).gradient,
                         f);
                });
}

void Contact::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  add_step_stiffness(x, {x, Vector::Zero(x.size()), {}}, p, k);
}

void Contact::add_step_stiffness(const Positions& x, const LinearStep& led, EffectParameters p,
                                 Stiffness& k) const {
  each_touching_face(
      *surface_, x, jaw(p),
      [&](const ContactFace& face, const auto& touching, const PlacedSurface& placed) {
        FaceStiffness sum;
        for (const TouchingPoint& t : touching) {
          const auto& w = t.point->weight;
          const auto s = placed.sample(t.at),
                     before = placed.sample(blend(led.from, face.nodes, w));
          const SoftSpring spring = contact_spring(t.depth),
                           was = contact_spring(t.point->clearance - before.value);
          const double slope = std::max(
              0.0, was.slope - was.curvature * before.gradient.dot(blend(led.step, face.nodes, w)));
          sum.add(*t.point,
                  p[0] * t.point->area *
                      (spring.curvature * s.gradient * s.gradient.transpose() - slope * s.hessian));
        }
        sum.add_to(face.nodes, k);
      });
}

void Contact::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                   Forces& df) const {
  each_touching(*surface_, x, jaw(p),
                [&](const Quad& nodes, const TouchingPoint& t, const PlacedSurface& placed) {
                  const SoftSpring spring = contact_spring(t.depth);
                  const Vec3 normal = placed.sample(t.at).gradient;
                  if (k == 0)
                    return spread(nodes, *t.point, t.point->area * spring.slope * normal, df);
                  const auto [distance, gradient] = placed.by_jaw(t.at, k == jaw_angle);
                  spread(nodes, *t.point,
                         p[0] * t.point->area *
                             (spring.slope * gradient - spring.curvature * distance * normal),
                         df);
                });
}

double Contact::step_limit(const Positions& x, const Positions& along, EffectParameters p) const {
  const PlacedSurface placed(*surface_, jaw(p));
  double t = 1.0;
  for (const int n : surface_->touchable->nodes) {
    const auto gap_at = [&](double s) {
      return placed.rough(node_position(x, n) + s * node_position(along, n));
    };
    const double deepest = std::min(-reach, 2 * gap_at(0));
    while (t > 1e-3 && gap_at(t) < deepest) t *= 0.7;
  }
  return t;
}

double Contact::max_penetration(const Positions& x, EffectParameters p) const {
  double deepest = 0;
  each_touching(*surface_, x, jaw(p), [&](const Quad&, const TouchingPoint& t, const auto&) {
    deepest = std::max(deepest, t.depth - std::max(0.0, t.point->clearance));
  });
  return deepest;
}

void Contact::add_force_along(const Positions& x, EffectParameters p, const Positions& rest,
                              std::span<const AnatomyMode* const> modes, Matrix& df) const {
  add_contact_rates(*surface_, p[0], x, jaw(p), rest, modes, of_bone_, df);
}

}  // namespace genio
