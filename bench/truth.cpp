#include "bench/truth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "forward/refine.hpp"

namespace genio::bench {
namespace {

/// Node in the middle of two old ones of one element: of an edge, a face's or the volume's
/// diagonal.
class Middles {
 public:
  Middles(const HexMesh& old, const HexMesh& fine) : old_(old) {
    for (size_t n = old.nodes.size(); n < fine.nodes.size(); ++n) at_[key(fine.nodes[n])] = int(n);
  }
  int operator()(int a, int b) const {
    const auto it = at_.find(key(0.5 * (old_.nodes[size_t(a)] + old_.nodes[size_t(b)])));
    return it == at_.end() ? -1 : it->second;
  }

 private:
  using Key = std::array<long long, 3>;
  static Key key(const Vec3& x) {
    Key k;
    for (int i = 0; i < 3; ++i) k[size_t(i)] = std::llround(x[i] * 1e10);
    return k;
  }
  const HexMesh& old_;
  std::map<Key, int> at_;
};

Fibre with_middles(const Fibre& fibre, const Middles& middle) {
  Fibre result;
  for (size_t k = 0; k < fibre.size(); ++k) {
    if (k > 0 && fibre[k - 1].node >= 0 && fibre[k].node >= 0)
      if (const int m = middle(fibre[k - 1].node, fibre[k].node); m >= 0)
        result.push_back({m, Vec3::Zero()});
    result.push_back(fibre[k]);
  }
  return result;
}

template <class Act>
void each_segment(const ModelDescription& d, Act act) {
  const Positions x = rest_positions(d.mesh);
  for (const Muscle& muscle : d.muscles)
    for (const Fibre& fibre : muscle.fibres)
      for (size_t k = 1; k < fibre.size(); ++k)
        act(Vec3(fibre[k].position(x) - fibre[k - 1].position(x)));
}

}  // namespace

ModelDescription refined(const ModelDescription& description) {
  ModelDescription d = description;
  const RefinedMesh fine = genio::refined(description.mesh, description.supports);
  const Middles middle(description.mesh, fine.mesh);
  d.mesh = fine.mesh, d.supports = fine.supports;
  for (Muscle& muscle : d.muscles) {
    for (Fibre& fibre : muscle.fibres) fibre = with_middles(fibre, middle);
    std::vector<int> children;
    for (int e : muscle.elements)
      for (int c = 0; c < 8; ++c) children.push_back(8 * e + c);
    muscle.elements = std::move(children);
  }
  return d;
}

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
