#include "forward/effects/muscles/extra_muscle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace genio {
namespace {

auto stretch(double force) {
  return [=](double i4) {
    const double root = std::sqrt(i4);
    return StretchEnergy{force * root, 0.5 * force / root, -0.25 * force / (root * i4)};
  };
}

}  // namespace

ExtraMuscle::ExtraMuscle(const HexMesh& mesh, const Vec3& from, const Vec3& to, double radius,
                         double force)
    : info_{{{"force", "N", force, 0, 50, 0, true, false, 3}}} {
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

}  // namespace genio
