#include "bench/experiments/hidden_change.hpp"

#include <algorithm>
#include <stdexcept>

#include "bench/experiments/foreign_effects.hpp"
#include "forward/effects/places.hpp"
#include "forward/model/effect_kinds.hpp"

namespace genio::bench {
namespace {

HiddenChange head_pose(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vec2 shift = 1e-3 * Vec2(normal(random), normal(random));
  const double turn = 0.02 * normal(random);
  HiddenChange c;
  c.effect = "head_pose", c.drawn = true, c.first = 1, c.most = 10;
  c.truth = c.shipped = [](ModelDescription d, double) { return d; };
  c.pose = [=](double s) { return HeadPose{s * shift, s * turn}; };
  // The pose that the data would have to be moved by.
  c.parameters = [=](double s) {
    return EffectTable{{"x", -s * shift[0]}, {"z", -s * shift[1]}, {"turn", -s * turn}};
  };
  return c;
}

HiddenChange lump(const ModelDescription& d, std::mt19937& random) {
  const Vec3 at = drawn_on_dorsum(d, random);
  HiddenChange c;
  c.effect = "lump", c.in_library = false, c.drawn = true, c.first = 1, c.most = 8;
  c.truth = [=](ModelDescription t, double s) {
    t.mesh = with_lump(std::move(t.mesh), at, Vec3(0.2, 0, 1), 0.014, 1e-3 * s);
    return t;
  };
  c.shipped = [](ModelDescription t, double) { return t; };
  c.parameters = [](double) { return EffectTable{}; };
  return c;
}

HiddenChange tether(const ModelDescription& d, std::mt19937& random) {
  const Vec3 at = drawn_on_dorsum(d, random);
  const Vec3 anchor = at + Vec3(-0.01, 0.03, 0.01);
  HiddenChange c;
  c.effect = "tether", c.in_library = false, c.symmetric = false, c.drawn = true, c.first = 30,
  c.most = 3000;
  c.truth = c.shipped = [](ModelDescription t, double) { return t; };
  c.by_hand = [=](const Model& m, double s) {
    ModelParts parts = m.parts();
    parts.effects.push_back({.potential = std::make_shared<Tether>(m.mesh, at, 0.009, anchor,
                                                                   0.8 * (anchor - at).norm(), s)});
    return Model(std::move(parts));
  };
  c.parameters = [](double) { return EffectTable{}; };
  return c;
}

}  // namespace

const std::vector<std::string>& hidden_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n;
    for (const EffectKind& kind : effect_kinds())
      if (kind.hidden) n.push_back(kind.name);
    n.insert(n.end(), {"head_pose", "lump", "tether"});
    return n;
  }();
  return names;
}

unsigned hidden_number(const std::string& name) {
  static const std::vector<std::string> measured_first = {"palate_contact",
                                                          "jaw_contact",
                                                          "gravity",
                                                          "active_stiffening",
                                                          "fibre_anisotropy",
                                                          "material_nonlinearity",
                                                          "compressibility",
                                                          "mucosa_layer",
                                                          "stiff_region",
                                                          "weak_muscle",
                                                          "extra_muscle",
                                                          "force_length",
                                                          "jaw_opening",
                                                          "hyoid_mobility",
                                                          "airway_pressure",
                                                          "head_pose",
                                                          "lump",
                                                          "tether"};
  const auto known = std::find(measured_first.begin(), measured_first.end(), name);
  if (known != measured_first.end()) return unsigned(known - measured_first.begin()) + 1;
  unsigned hash = 2166136261u;  // FNV-1a, the same on every machine
  for (const unsigned char c : name) hash = (hash ^ c) * 16777619u;
  return 101 + hash % 100000;
}

HiddenChange hidden_change(const std::string& name, const ChangeDraw& draw) {
  if (const EffectKind* kind = find_kind(name); kind && kind->hidden) return {kind->hidden(draw)};
  if (name == "head_pose") return head_pose(draw.random);
  if (name == "lump") return lump(draw.tongue, draw.random);
  if (name == "tether") return tether(draw.tongue, draw.random);
  throw std::invalid_argument("no such hidden change: " + name);
}

}  // namespace genio::bench
