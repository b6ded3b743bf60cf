#include "forward/effects/bones/jaw_opening.hpp"

namespace genio {
namespace {

constexpr double spring = 2.5e4;  // of an element at a node [N/m]

}  // namespace

JawOpening::JawOpening(std::vector<int> nodes, const HexMesh& mesh, const JawMotion& motion)
    : nodes_(std::move(nodes)),
      rest_(rest_positions(mesh)),
      hinge_(motion.hinge),
      info_{{{"angle", "deg", motion.angle, -5, 40, 0, true, false, 4},
             {"slide", "m", motion.slide, -0.01, 0.02, 0, true, false, 3e-3}}} {
  std::vector<int> elements(mesh.nodes.size(), 0);
  for (const auto& e : mesh.elements)
    for (int a : e) ++elements[size_t(a)];
  for (int a : nodes_) springs_.push_back(spring * elements[size_t(a)]);
}

double JawOpening::energy(const Positions& x, EffectParameters p) const {
  const JawMotion jaw = motion(p);
  double e = 0;
  for (size_t i = 0; i < nodes_.size(); ++i)
    e += 0.5 * springs_[i] *
         (node_position(x, nodes_[i]) - jaw(node_position(rest_, nodes_[i]))).squaredNorm();
  return e;
}

void JawOpening::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  const JawMotion jaw = motion(p);
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const int a = nodes_[i];
    f.segment<3>(3 * a) += springs_[i] * (jaw(node_position(rest_, a)) - node_position(x, a));
  }
}

void JawOpening::add_stiffness(const Positions&, EffectParameters, Stiffness& k) const {
  for (size_t i = 0; i < nodes_.size(); ++i)
    k.add(nodes_[i], nodes_[i], springs_[i] * Mat3::Identity());
}

void JawOpening::add_force_derivative(const Positions&, EffectParameters p, int k,
                                      Forces& df) const {
  const JawMotion jaw = motion(p);
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const int a = nodes_[i];
    if (k == 0) df.segment<3>(3 * a) += springs_[i] * jaw.by_angle(node_position(rest_, a));
    else df[3 * a] -= springs_[i];  // forwards is -x
  }
}

}  // namespace genio
