#include "forward/effects/bones/hyoid_mobility.hpp"

#include <cmath>

namespace genio {
namespace {

constexpr double least_compliance = 1e-8;  // [m/N]

/// Spring constants along x, y and z [N/m].
Vec3 springs(EffectParameters p) { return {p[1], p[1], 1 / (p[0] + least_compliance)}; }

/// The nodes that move as one body. Throws InputError where there are none.
HyoidBody hyoid_body(const Anatomy& a) {
  HyoidBody body{nodes_with(a, Support::body), {}};
  const auto of_half = nodes_with(a, Support::sagittal);
  if (body.nodes.empty() && of_half.empty())
    throw InputError(a.source + ": [effect.hyoid_mobility] needs nodes with support 2 (hyoid)");
  body.shares.assign(body.nodes.size(), 1.0);
  double whole = double(body.nodes.size());
  for (int n : of_half) {
    const bool middle = std::abs(a.description.mesh.nodes[size_t(n)][1]) < on_plane;
    body.nodes.push_back(n), body.shares.push_back(middle ? 0.5 : 1.0);
    whole += 2 * body.shares.back();
  }
  for (double& share : body.shares) share /= whole;
  return body;
}

}  // namespace

HyoidMobility::HyoidMobility(HyoidBody body, const Positions& rest, double compliance_z,
                             double stiffness_xy)
    : body_(std::move(body)),
      info_{{{.name = "compliance_z", .unit = "m/N", .value = compliance_z, .upper = 1},
             {.name = "stiffness_xy", .unit = "N/m", .value = stiffness_xy, .upper = 1e5}}} {
  for (int a : body_.nodes) rest_.push_back(node_position(rest, a));
}

double HyoidMobility::energy(const Positions& x, EffectParameters p) const {
  double sum = 0;
  for (size_t i = 0; i < body_.nodes.size(); ++i)
    sum += 0.5 * body_.shares[i] * springs(p).dot(displacement(x, i).cwiseAbs2());
  return sum;
}

void HyoidMobility::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  for (size_t i = 0; i < body_.nodes.size(); ++i)
    f.segment<3>(3 * body_.nodes[i]) -=
        body_.shares[i] * springs(p).cwiseProduct(displacement(x, i));
}

void HyoidMobility::add_stiffness(const Positions&, EffectParameters p, Stiffness& k) const {
  for (size_t i = 0; i < body_.nodes.size(); ++i)
    k.add(body_.nodes[i], body_.nodes[i], (body_.shares[i] * springs(p)).asDiagonal());
}

void HyoidMobility::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                         Forces& df) const {
  const double kz = springs(p)[2];
  for (size_t i = 0; i < body_.nodes.size(); ++i) {
    const Vec3 u = body_.shares[i] * displacement(x, i);
    if (k == 0) df[3 * body_.nodes[i] + 2] += kz * kz * u[2];
    if (k == 1) df.segment<2>(3 * body_.nodes[i]) -= u.head<2>();
  }
}

HyoidMass::HyoidMass(HyoidBody body, double mass)
    : body_(std::move(body)),
      info_{{{.name = "mass", .unit = "kg", .value = mass, .upper = 1, .absent = mass}}} {}

void HyoidMass::add_mass(EffectParameters p, Vector& mass) const {
  for (size_t i = 0; i < body_.nodes.size(); ++i) mass[body_.nodes[i]] += body_.shares[i] * p[0];
}

EffectKind hyoid_mobility_kind() {
  return {.name = "hyoid_mobility",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const HyoidBody body = hyoid_body(a);
            const double compliance = s.take("compliance_z", 0),
                         stiffness = s.take("stiffness_xy", 0);
            return {.potential = std::make_shared<HyoidMobility>(
                        body, rest_positions(a.description.mesh), compliance, stiffness),
                    .inertia = std::make_shared<HyoidMass>(body, s.take("mass", 0.01))};
          },
          .external = true,
          .support =
              [](Support s) {
                if (s == Support::horizontal) return Support::body;
                return s == Support::forward ? Support::sagittal : s;
              },
          .belief = {.parameters = {{.parameter = "compliance_z", .typical = 2e-3},
                                    {.parameter = "stiffness_xy", .typical = 500}}},
          .sample = {{"compliance_z", 1e-3}, {"stiffness_xy", 100}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_number(
                    "hyoid_mobility",
                    {.key = "compliance_z", .absent = 0, .unit = 1e-3, .first = 1, .most = 100});
              }};
}

}  // namespace genio
