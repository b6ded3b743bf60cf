#include "forward/effects/surroundings/contact_damping.hpp"

namespace genio {
namespace {

constexpr int damped_jaw_angle = 2;  // borrowed, after damping and the contact's stiffness

EffectParameters damped_jaw(EffectParameters p) { return p.subspan(damped_jaw_angle); }

/// Damping coefficient per spring force [N s/m per N, times Pa/m].
double strength(EffectParameters p) { return p[1] * p[0]; }

}  // namespace

ContactDamping::ContactDamping(std::string name, std::shared_ptr<const ContactSurface> surface,
                               double damping)
    : name_(std::move(name)),
      surface_(std::move(surface)),
      info_{{{.name = "damping", .unit = "s/m", .value = damping, .lower = 0, .upper = 1e4}}} {}

std::vector<ParameterName> ContactDamping::borrows() const {
  std::vector<ParameterName> names = surface_->borrows();
  names.insert(names.begin(), {name_, "stiffness"});
  return names;
}

void ContactDamping::add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                                       Forces& f) const {
  if (p[0] == 0) return;
  each_touching(
      *surface_, x, damped_jaw(p),
      [&](const Quad& nodes, const TouchingPoint& t, const PlacedSurface& placed) {
        const Vec3 normal = placed.sample(t.at).gradient;
        const double rate = normal.dot(blend(v, nodes, t.point->weight));
        spread(nodes, *t.point,
               -strength(p) * t.point->area * contact_spring(t.depth).slope * rate * normal, f);
      });
}

void ContactDamping::add_damping(const Positions& x, const Vector&, EffectParameters p,
                                 Stiffness& damping) const {
  if (p[0] == 0) return;
  each_touching_face(
      *surface_, x, damped_jaw(p),
      [&](const ContactFace& face, const auto& touching, const PlacedSurface& placed) {
        FaceStiffness sum;
        for (const TouchingPoint& t : touching) {
          const Vec3 normal = placed.sample(t.at).gradient;
          sum.add(*t.point, strength(p) * t.point->area * contact_spring(t.depth).slope * normal *
                                normal.transpose());
        }
        sum.add_to(face.nodes, damping);
      });
}

void ContactDamping::add_viscous_force_slope(const Positions& x, const Vector& v,
                                             EffectParameters p, const Matrix& along, Stiffness&,
                                             Matrix& df) const {
  if (p[0] == 0) return;
  each_touching(*surface_, x, damped_jaw(p),
                [&](const Quad& nodes, const TouchingPoint& t, const PlacedSurface& placed) {
                  const auto s = placed.sample(t.at);
                  const SoftSpring spring = contact_spring(t.depth);
                  const auto& w = t.point->weight;
                  const Vec3 &n = s.gradient, speed = blend(v, nodes, w);
                  const Mat3 slope = -spring.curvature * n.dot(speed) * n * n.transpose() +
                                     spring.slope * (n * (s.hessian * speed).transpose() +
                                                     n.dot(speed) * s.hessian);
                  Matrix moved = Matrix::Zero(3, along.cols());
                  for (size_t a = 0; a < 4; ++a) moved += w[a] * along.middleRows<3>(3 * nodes[a]);
                  moved = strength(p) * t.point->area * (slope * moved);
                  for (size_t a = 0; a < 4; ++a) df.middleRows<3>(3 * nodes[a]) -= w[a] * moved;
                });
}

void ContactDamping::add_viscous_force_derivative(const Positions& x, const Vector& v,
                                                  EffectParameters p, int k, Forces& df) const {
  if (k < damped_jaw_angle) {  // linear in damping and in stiffness
    std::vector<double> unit(p.begin(), p.end());
    unit[size_t(k)] = 1;
    add_viscous_force(x, v, unit, df);
    return;
  }
  each_touching(
      *surface_, x, damped_jaw(p),
      [&](const Quad& nodes, const TouchingPoint& t, const PlacedSurface& placed) {
        const SoftSpring spring = contact_spring(t.depth);
        const Vec3 normal = placed.sample(t.at).gradient;
        const Vec3 speed = blend(v, nodes, t.point->weight);
        const auto [distance, gradient] = placed.by_jaw(t.at, k == damped_jaw_angle);
        spread(nodes, *t.point,
               -strength(p) * t.point->area *
                   (-spring.curvature * distance * normal.dot(speed) * normal +
                    spring.slope * (gradient.dot(speed) * normal + normal.dot(speed) * gradient)),
               df);
      });
}

}  // namespace genio
