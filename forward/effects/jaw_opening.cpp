#include "forward/effects/jaw_opening.hpp"

namespace genio {
namespace {

constexpr double spring = 1e5;  // [N/m]

}  // namespace

JawOpening::JawOpening(std::vector<int> nodes, const Positions& rest, const JawMotion& motion)
    : nodes_(std::move(nodes)),
      rest_(rest),
      hinge_(motion.hinge),
      info_{{{"angle", "deg", motion.angle, -5, 40, 0, true, false, 4},
             {"slide", "m", motion.slide, -0.01, 0.02, 0, true, false, 3e-3}}} {}

double JawOpening::energy(const Positions& x, EffectParameters p) const {
  const JawMotion jaw = motion(p);
  double e = 0;
  for (int a : nodes_)
    e += 0.5 * spring * (node_position(x, a) - jaw(node_position(rest_, a))).squaredNorm();
  return e;
}

void JawOpening::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  const JawMotion jaw = motion(p);
  for (int a : nodes_)
    f.segment<3>(3 * a) += spring * (jaw(node_position(rest_, a)) - node_position(x, a));
}

void JawOpening::add_stiffness(const Positions&, EffectParameters, Stiffness& k) const {
  for (int a : nodes_) k.add(a, a, spring * Mat3::Identity());
}

void JawOpening::add_force_derivative(const Positions&, EffectParameters p, int k,
                                      Forces& df) const {
  const JawMotion jaw = motion(p);
  for (int a : nodes_) {
    if (k == 0) df.segment<3>(3 * a) += spring * jaw.by_angle(node_position(rest_, a));
    else df[3 * a] -= spring;  // forwards is -x
  }
}

}  // namespace genio
