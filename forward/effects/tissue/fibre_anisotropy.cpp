#include "forward/effects/tissue/fibre_anisotropy.hpp"

#include <Eigen/Eigenvalues>

#include "forward/geometry/mesh.hpp"
#include "forward/tissue/segment_forces.hpp"
#include "forward/tissue/soft_spring.hpp"

namespace genio {
namespace {

constexpr double toe = 0.1;
constexpr double neighbourhood = 6e-3;  // [m]

auto fibre_law(double modulus) {
  return [=](double i4) {
    const SoftSpring s(i4 - 1, toe);
    return StretchEnergy{0.25 * modulus * s.value, 0.25 * modulus * s.slope,
                         0.25 * modulus * s.curvature};
  };
}

}  // namespace

Vec3 fibre_direction(const Muscle& muscle, const Positions& rest, const Vec3& point) {
  std::vector<std::pair<double, const FibreSegment*>> near;  // squared distance, segment
  for (const bool all : {false, true}) {
    if (!near.empty()) break;
    for (const auto& s : muscle.segments) {
      const Vec3 middle = 0.5 * (s.start.position(rest) + s.end.position(rest));
      if (all || std::abs(middle[1]) < on_plane || middle[1] * point[1] > 0)
        near.emplace_back((middle - point).squaredNorm(), &s);
    }
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [square, s] : near) nearest = std::min(nearest, square);
  Mat3 sum = Mat3::Zero();
  for (const auto& [square, s] : near) {
    const Vec3 t = span(*s, rest).normalized();
    sum += std::exp((nearest - square) / (neighbourhood * neighbourhood)) * t * t.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Mat3>(sum).eigenvectors().col(2);
}

FibreAnisotropy::FibreAnisotropy(const HexMesh& mesh, const std::vector<Muscle>& muscles,
                                 double modulus)
    : info_{{{.name = "modulus", .unit = "Pa", .value = modulus, .lower = 0, .upper = 1e6}}} {
  const Positions rest = rest_positions(mesh);
  std::vector<int> families(mesh.elements.size(), 0);
  for (const Muscle& m : muscles)
    for (int e : m.elements) ++families[size_t(e)];
  for (const Muscle& m : muscles)
    for (int e : m.elements)
      for (int q = 0; q < 8; ++q)
        samples_.push_back(fibre_sample(mesh, e, q,
                                        fibre_direction(m, rest, gauss_point(mesh, e, q)),
                                        1.0 / families[size_t(e)]));
}

double FibreAnisotropy::energy(const Positions& x, EffectParameters p) const {
  return p[0] == 0 ? 0 : field_energy(samples_, x, fibre_law(p[0]));
}

void FibreAnisotropy::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  if (p[0] != 0) add_field_force(samples_, x, fibre_law(p[0]), f);
}

void FibreAnisotropy::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  if (p[0] != 0) add_field_stiffness(samples_, x, fibre_law(p[0]), k);
}

void FibreAnisotropy::add_force_derivative(const Positions& x, EffectParameters, int,
                                           Forces& df) const {
  add_field_force(samples_, x, fibre_law(1.0), df);
}

EffectKind fibre_anisotropy_kind() {
  return {.name = "fibre_anisotropy",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            return {.potential = std::make_shared<FibreAnisotropy>(a.description.mesh, a.muscles,
                                                                   s.take("modulus", 0))};
          },
          .belief = {.parameters = {{.parameter = "modulus", .typical = 5e3}}},
          .sample = {{"modulus", 900}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_number(
                    "fibre_anisotropy",
                    {.key = "modulus", .absent = 0, .unit = 1e3, .first = 4, .most = 200});
              }};
}

}  // namespace genio
