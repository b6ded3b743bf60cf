#include "forward/effects/bones/jaw_opening.hpp"

namespace genio {
namespace {

constexpr double spring = 2.5e4;  // of an element at a node [N/m]

Vec3 hinge(Settings& s) { return s.take_point("hinge_", JawMotion{}.hinge); }

}  // namespace

JawOpening::JawOpening(std::vector<int> nodes, const HexMesh& mesh, const JawMotion& motion)
    : nodes_(std::move(nodes)),
      rest_(rest_positions(mesh)),
      hinge_(motion.hinge),
      info_{{{.name = "angle",
              .unit = "deg",
              .value = motion.angle,
              .lower = -5,
              .upper = 40,
              .load = true},
             {.name = "slide",
              .unit = "m",
              .value = motion.slide,
              .lower = -0.01,
              .upper = 0.02,
              .load = true}}} {
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

std::optional<Vec3> opening_hinge(const Anatomy& a) {
  const auto jaw = a.description.effects.find("jaw_opening");
  if (jaw == a.description.effects.end()) return {};
  Settings opening(a.source, "jaw_opening", jaw->second);
  return hinge(opening);
}

EffectKind jaw_opening_kind() {
  return {.name = "jaw_opening",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const JawMotion motion{hinge(s), s.take("angle", 0), s.take("slide", 0)};
            return {.potential = std::make_shared<JawOpening>(nodes_with(a, Support::led),
                                                              a.description.mesh, motion)};
          },
          .main = "angle",
          .external = true,
          .support = [](Support s) { return s == Support::fixed ? Support::led : s; },
          .belief = {.parameters = {{.parameter = "angle", .typical = 4},
                                    {.parameter = "slide", .typical = 3e-3}}},
          .sample = {{"angle", 3}, {"slide", 4e-4}, {"hinge_x", 0.05}, {"hinge_z", 0.02}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_number(
                    "jaw_opening",
                    {.key = "angle", .absent = 0, .unit = 1, .first = 2, .most = 20});
              }};
}

}  // namespace genio
