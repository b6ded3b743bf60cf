#include "forward/effects/contact.hpp"

#include <algorithm>

namespace genio {
namespace {

constexpr double reach = 4e-3;  // [m]

/// phi, phi' and phi'' of the depth d = -g > 0 with respect to d.
struct Spring {
  double value, slope, curvature;
  explicit Spring(double d) {
    constexpr double s = Contact::soft_depth;
    if (d < s) value = d * d * d / (6 * s), slope = d * d / (2 * s), curvature = d / s;
    else value = d * d / 2 - s * d / 2 + s * s / 6, slope = d - s / 2, curvature = 1;
  }
};

}  // namespace

Contact::Contact(std::string name, std::shared_ptr<const DistanceField> field,
                 std::vector<ContactNode> nodes, double stiffness)
    : name_(std::move(name)),
      field_(std::move(field)),
      nodes_(std::move(nodes)),
      info_{{{"stiffness", "Pa/m", stiffness, 0, 1e12, 0, false, true}}} {}

double Contact::gap(const Positions& x, const ContactNode& c) const {
  return field_->value(node_position(x, c.node)) - c.clearance;
}

double Contact::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  for (const auto& c : nodes_)
    if (const double g = gap(x, c); g < 0) e += p[0] * c.area * Spring(-g).value;
  return e;
}

void Contact::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  for (const auto& c : nodes_) {
    if (gap(x, c) >= 0) continue;
    const auto s = field_->sample(node_position(x, c.node));
    f.segment<3>(3 * c.node) += p[0] * c.area * Spring(c.clearance - s.value).slope * s.gradient;
  }
}

void Contact::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  add_step_stiffness(x, x, Vector::Zero(x.size()), p, k);
}

void Contact::add_step_stiffness(const Positions& x, const Positions& previous, const Vector& step,
                                 EffectParameters p, Stiffness& k) const {
  for (const auto& c : nodes_) {
    if (gap(x, c) >= 0) continue;
    const auto s = field_->sample(node_position(x, c.node));
    const Spring spring(c.clearance - s.value);
    const auto before = field_->sample(node_position(previous, c.node));
    const double depth = c.clearance - before.value;
    double slope = 0;
    if (depth > 0) {
      const Spring was(depth);
      slope = std::max(
          0.0, was.slope - was.curvature * before.gradient.dot(node_position(step, c.node)));
    }
    k.add(c.node, c.node,
          p[0] * c.area *
              (spring.curvature * s.gradient * s.gradient.transpose() - slope * s.hessian));
  }
}

void Contact::add_force_derivative(const Positions& x, EffectParameters, int, Forces& df) const {
  const double one[] = {1.0};
  add_force(x, one, df);  // the force is linear in the stiffness
}

double Contact::step_limit(const Positions& x, const Positions& along) const {
  double t = 1.0;
  for (const auto& c : nodes_) {
    const double deepest = std::min(-reach, 2 * gap(x, c));
    const auto gap_at = [&](double s) {
      return field_->value(node_position(x, c.node) + s * node_position(along, c.node)) -
             c.clearance;
    };
    while (t > 1e-3 && gap_at(t) < deepest) t *= 0.7;
  }
  return t;
}

double Contact::max_penetration(const Positions& x) const {
  double depth = 0;
  for (const auto& c : nodes_) depth = std::max(depth, -gap(x, c));
  return depth;
}

}  // namespace genio
