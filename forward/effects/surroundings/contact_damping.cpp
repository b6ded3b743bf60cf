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
  each_touching(*surface_, x, damped_jaw(p),
                [&](const ContactNode& c, const auto& surface, double depth) {
                  const Vec3 normal = surface.sample(node_position(x, c.node)).gradient;
                  f.segment<3>(3 * c.node) -= strength(p) * c.area * contact_spring(depth).slope *
                                              normal.dot(node_position(v, c.node)) * normal;
                });
}

void ContactDamping::add_damping(const Positions& x, const Vector&, EffectParameters p,
                                 Stiffness& damping) const {
  if (p[0] == 0) return;
  each_touching(
      *surface_, x, damped_jaw(p), [&](const ContactNode& c, const auto& surface, double depth) {
        const Vec3 normal = surface.sample(node_position(x, c.node)).gradient;
        damping.add(
            c.node, c.node,
            strength(p) * c.area * contact_spring(depth).slope * normal * normal.transpose());
      });
}

void ContactDamping::add_viscous_force_slope(const Positions& x, const Vector& v,
                                             EffectParameters p, const Matrix& along, Stiffness&,
                                             Matrix& df) const {
  if (p[0] == 0) return;
  each_touching(
      *surface_, x, damped_jaw(p), [&](const ContactNode& c, const auto& surface, double depth) {
        const auto s = surface.sample(node_position(x, c.node));
        const SoftSpring spring = contact_spring(depth);
        const Vec3 &n = s.gradient, speed = node_position(v, c.node);
        const Mat3 slope =
            -spring.curvature * n.dot(speed) * n * n.transpose() +
            spring.slope * (n * (s.hessian * speed).transpose() + n.dot(speed) * s.hessian);
        df.middleRows<3>(3 * c.node) -=
            strength(p) * c.area * slope * along.middleRows<3>(3 * c.node);
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
      *surface_, x, damped_jaw(p), [&](const ContactNode& c, const auto& surface, double depth) {
        const SoftSpring spring = contact_spring(depth);
        const Vec3 at = node_position(x, c.node), normal = surface.sample(at).gradient;
        const Vec3 speed = node_position(v, c.node);
        const auto [distance, gradient] = surface.by_jaw(at, k == damped_jaw_angle);
        df.segment<3>(3 * c.node) -=
            strength(p) * c.area *
            (-spring.curvature * distance * normal.dot(speed) * normal +
             spring.slope * (gradient.dot(speed) * normal + normal.dot(speed) * gradient));
      });
}

}  // namespace genio
