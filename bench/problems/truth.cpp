#include "bench/problems/truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace genio::bench {
namespace {

template <class Act>
void each_segment(const ModelDescription& d, Act act) {
  const Positions x = rest_positions(d.mesh);
  for (const Muscle& muscle : d.muscles)
    for (const Fibre& fibre : muscle.fibres)
      for (size_t k = 1; k < fibre.size(); ++k)
        act(Vec3(fibre[k].position(x) - fibre[k - 1].position(x)));
}

}  // namespace

double mean_turn(const ModelDescription& a, const ModelDescription& b) {
  std::vector<Vec3> first;
  each_segment(a, [&](const Vec3& s) { first.push_back(s.normalized()); });
  double sum = 0;
  size_t k = 0;
  each_segment(b, [&](const Vec3& s) {
    sum += std::acos(std::clamp(s.normalized().dot(first[k++]), -1.0, 1.0));
  });
  return sum / double(first.size()) * 180 / std::numbers::pi;
}

ModelDescription with_turned_fibres(ModelDescription description, double degrees, unsigned seed) {
  const ModelDescription original = description;
  HexMesh& mesh = description.mesh;
  std::vector<bool> free(mesh.nodes.size(), true);
  for (const Quad& q : boundary_quads(mesh))
    for (int a : q) free[size_t(a)] = false;
  for (size_t a = 0; a < free.size(); ++a)
    if (description.supports[a] != Support::free) free[a] = false;
  // Waves of about two elements' length, left and right alike.
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
  constexpr double wavelength = 0.03;  // [m]
  struct Wave {
    Vec3 direction, number;
    double phase;
  };
  std::vector<Wave> waves(24);
  for (Wave& w : waves) {
    const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    w = {vector(), 2 * std::numbers::pi / wavelength * vector().normalized(), phase(random)};
  }
  std::vector<Vec3> field(mesh.nodes.size(), Vec3::Zero());
  for (size_t a = 0; a < field.size(); ++a) {
    if (!free[a]) continue;
    const Vec3& x = original.mesh.nodes[a];
    const Vec3 there(x[0], std::abs(x[1]), x[2]);
    for (const Wave& w : waves) field[a] += std::sin(w.number.dot(there) + w.phase) * w.direction;
    field[a][1] *= std::abs(x[1]) < 1e-6 ? 0 : x[1] > 0 ? 1 : -1;
  }
  double scale = 1e-5;
  for (int i = 0; i < 12; ++i) {
    for (size_t a = 0; a < field.size(); ++a)
      mesh.nodes[a] = original.mesh.nodes[a] + scale * field[a];
    scale *= degrees / mean_turn(original, description);
  }
  return description;
}

}  // namespace genio::bench
