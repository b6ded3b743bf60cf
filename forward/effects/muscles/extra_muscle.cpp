#include "forward/effects/muscles/extra_muscle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "forward/effects/places.hpp"

namespace genio {
namespace {

auto stretch(double force) {
  return [=](double i4) {
    const double root = std::sqrt(i4);
    return StretchEnergy{force * root, 0.5 * force / root, -0.25 * force / (root * i4)};
  };
}

/// A bundle along a course of its own, near one that anatomy knows.
EffectChange hidden_bundle(const ChangeDraw& draw) {
  const ModelDescription& d = draw.tongue;
  std::mt19937& random = draw.random;
  std::normal_distribution<double> jitter(0, 1.5e-3);
  const Vec3 root = d.mesh.nodes[size_t(d.landmarks.root)],
             dorsum = d.mesh.nodes[size_t(d.landmarks.dorsum)];
  Vec3 chin = Vec3::Zero(), hyoid = Vec3::Zero();
  int chins = 0, hyoids = 0;
  for (size_t a = 0; a < d.supports.size(); ++a) {
    if (d.supports[a] == Support::fixed) chin += d.mesh.nodes[a], ++chins;
    if (d.supports[a] == Support::horizontal) hyoid += d.mesh.nodes[a], ++hyoids;
  }
  chin /= std::max(1, chins), hyoid /= std::max(1, hyoids);
  Vec3 from, to;
  bool symmetric = true;
  switch (random() % 3) {
    case 0:  // horizontal genioglossus
      from = Vec3(chin[0], 0, chin[2]), to = root;
      break;
    case 1:  // chondroglossus of the right
      from = Vec3(hyoid[0], 0.004, hyoid[2]), to = dorsum + Vec3(0, 0.010, 0);
      symmetric = false;
      break;
    default:  // across the back
      from = root + Vec3(-0.008, -0.02, 0.01), to = root + Vec3(-0.008, 0.02, 0.01);
  }
  Vec3 shift(jitter(random), 0, jitter(random));
  from += shift, to += shift;
  EffectChange change = change_by_table(
      "extra_muscle",
      [=](double s) {
        return EffectTable{{"from_x", from[0]}, {"from_y", from[1]}, {"from_z", from[2]},
                           {"to_x", to[0]},     {"to_y", to[1]},     {"to_z", to[2]},
                           {"force", s}};
      },
      2, 40);
  change.symmetric = symmetric, change.drawn = true;
  return change;
}

}  // namespace

ExtraMuscle::ExtraMuscle(const HexMesh& mesh, const Vec3& from, const Vec3& to, double radius,
                         double force)
    : info_{
          {{.name = "force", .unit = "N", .value = force, .lower = 0, .upper = 50, .load = true}}} {
  const double length = (to - from).norm();
  if (!(length > 0) || !(radius > 0))
    throw InputError(
        "[effect.extra_muscle] needs from_x, from_y, from_z, to_x, to_y, to_z of a "
        "bundle with a length, and a radius above 0");
  const Vec3 axis = (to - from) / length;
  const double area = std::numbers::pi * radius * radius / 3;
  for (int e = 0; e < int(mesh.elements.size()); ++e)
    for (int q = 0; q < 8; ++q) {
      const Vec3 x = gauss_point(mesh, e, q);
      const double along = std::clamp((x - from).dot(axis), 0.0, length);
      const double inside = 1 - (x - from - along * axis).squaredNorm() / (radius * radius);
      if (inside > 0) samples_.push_back(fibre_sample(mesh, e, q, axis, inside * inside / area));
    }
  if (samples_.empty())
    throw InputError(
        "[effect.extra_muscle]: the bundle meets no tissue; its points are in metres "
        "in the frame of the mesh");
}

double ExtraMuscle::energy(const Positions& x, EffectParameters p) const {
  return p[0] == 0 ? 0 : field_energy(samples_, x, stretch(p[0]));
}

void ExtraMuscle::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  if (p[0] != 0) add_field_force(samples_, x, stretch(p[0]), f);
}

void ExtraMuscle::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  if (p[0] != 0) add_field_stiffness(samples_, x, stretch(p[0]), k);
}

void ExtraMuscle::add_force_derivative(const Positions& x, EffectParameters, int,
                                       Forces& df) const {
  add_field_force(samples_, x, stretch(1.0), df);
}

EffectKind extra_muscle_kind() {
  return {.name = "extra_muscle",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const Vec3 from = s.take_point("from_", Vec3::Zero()),
                       to = s.take_point("to_", Vec3::Zero());
            const double radius = s.take("radius", 8e-3), force = s.take("force", 0);
            return {.potential =
                        std::make_shared<ExtraMuscle>(a.description.mesh, from, to, radius, force)};
          },
          .belief = {.parameters = {{.parameter = "force", .typical = 3}}},
          .places = muscle_courses,
          .sample = {{"from_x", 0.001},
                     {"from_y", 0.005},
                     {"from_z", 0.008},
                     {"to_x", 0.014},
                     {"to_y", 0.005},
                     {"to_z", 0.004},
                     {"radius", 0.004},
                     {"force", 0.3}},
          .hidden = hidden_bundle};
}

}  // namespace genio
