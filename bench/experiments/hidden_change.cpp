#include "bench/experiments/hidden_change.hpp"

#include <stdexcept>

#include "bench/experiments/foreign_effects.hpp"

namespace genio::bench {
namespace {

using Table = std::map<std::string, double>;

/// Adds `table(s)` as [effect.NAME].
HiddenChange by_table(const std::string& name, std::function<Table(double)> table, double first,
                      double most) {
  HiddenChange c;
  c.effect = name, c.first = first, c.most = most;
  c.truth = [=](ModelDescription d, double s) {
    for (const auto& [key, value] : table(s)) d.effects[name][key] = value;
    return d;
  };
  c.shipped = [](ModelDescription d, double) { return d; };
  c.parameters = table;
  return c;
}

HiddenChange by_number(const std::string& name, const std::string& key, double absent, double unit,
                       double first, double most) {
  return by_table(
      name,
      [=](double s) {
        return Table{{key, absent + s * unit}};
      },
      first, most);
}

/// A bone that touches; the nearer it lies the more it does. Its place is known to the model.
HiddenChange contact(const std::string& name, const Vec3& nearer) {
  HiddenChange c;
  c.effect = name, c.first = 4, c.most = 12;
  const auto moved = [=](ModelDescription d, double s) {
    auto& surface = name == "palate_contact" ? d.palate : d.jaw;
    for (Vec3& v : surface->vertices) v += 1e-3 * s * nearer;
    return d;
  };
  c.truth = [=](ModelDescription d, double s) {
    d = moved(std::move(d), s);
    d.effects[name] = {{"stiffness", 2e8}};
    return d;
  };
  c.shipped = [=](ModelDescription d, double s) {
    d = moved(std::move(d), s);
    d.effects.erase(name);
    return d;
  };
  c.parameters = [](double) { return Table{}; };
  return c;
}

Vec3 node(const ModelDescription& d, int a) { return d.mesh.nodes[size_t(a)]; }

/// A place on the midsagittal line between tip and root, jittered.
Vec3 on_dorsum(const ModelDescription& d, std::mt19937& random) {
  size_t tip = 0;
  while (d.midsagittal[tip] != d.landmarks.tip) ++tip;
  const size_t last = d.midsagittal.size() - 2;
  std::uniform_int_distribution<size_t> pick(tip + 2, last);
  return node(d, d.midsagittal[pick(random)]);
}

HiddenChange stiff_region(const ModelDescription& d, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec3 top = on_dorsum(d, random);
  Vec3 at = top + Vec3(0, 0, -0.008 - 0.004 * (1 + uniform(random)));
  const double side = uniform(random);
  at[1] = std::abs(side) < 0.4 ? 0 : 0.012 * (side > 0 ? 1 : -1);
  const double radius = 0.016 + 0.003 * uniform(random);
  const bool softer = random() % 2;
  auto c = by_table(
      "stiff_region",
      [=](double s) {
        return Table{{"factor", softer ? std::max(0.05, 1 / (1 + s)) : 1 + s},
                     {"x", at[0]},
                     {"y", at[1]},
                     {"z", at[2]},
                     {"radius", radius}};
      },
      4, 60);
  c.symmetric = at[1] == 0, c.drawn = true;
  return c;
}

HiddenChange weak_muscle(const std::vector<std::string>& active, bool forces_known,
                         std::mt19937& random) {
  std::uniform_int_distribution<size_t> pick(0, std::min<size_t>(3, active.size() - 1));
  const std::string muscle = active[pick(random)];
  if (muscle == "SL") return weak_muscle(active, forces_known, random);
  const unsigned sides = forces_known ? unsigned(random() % 3) : unsigned(random() % 2);
  const auto keys = sides == 0   ? std::vector{muscle + "_L"}
                    : sides == 1 ? std::vector{muscle + "_R"}
                                 : std::vector{muscle + "_L", muscle + "_R"};
  auto c = by_table(
      "weak_muscle",
      [=](double s) {
        Table t;
        for (const auto& key : keys) t[key] = s;
        return t;
      },
      0.3, 1);
  c.where = sides == 2 ? muscle : keys.front(), c.symmetric = sides == 2, c.drawn = true;
  return c;
}

/// A bundle along a course of its own, near one that anatomy knows.
HiddenChange extra_muscle(const ModelDescription& d, std::mt19937& random) {
  std::normal_distribution<double> jitter(0, 1.5e-3);
  const Vec3 root = node(d, d.landmarks.root), dorsum = node(d, d.landmarks.dorsum);
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
  auto c = by_table(
      "extra_muscle",
      [=](double s) {
        return Table{{"from_x", from[0]}, {"from_y", from[1]}, {"from_z", from[2]}, {"to_x", to[0]},
                     {"to_y", to[1]},     {"to_z", to[2]},     {"force", s}};
      },
      2, 40);
  c.symmetric = symmetric, c.drawn = true;
  return c;
}

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
    return Table{{"x", -s * shift[0]}, {"z", -s * shift[1]}, {"turn", -s * turn}};
  };
  return c;
}

HiddenChange lump(const ModelDescription& d, std::mt19937& random) {
  const Vec3 at = on_dorsum(d, random);
  HiddenChange c;
  c.effect = "lump", c.in_library = false, c.drawn = true, c.first = 1, c.most = 8;
  c.truth = [=](ModelDescription t, double s) {
    t.mesh = with_lump(std::move(t.mesh), at, Vec3(0.2, 0, 1), 0.014, 1e-3 * s);
    return t;
  };
  c.shipped = [](ModelDescription t, double) { return t; };
  c.parameters = [](double) { return Table{}; };
  return c;
}

HiddenChange tether(const ModelDescription& d, std::mt19937& random) {
  const Vec3 at = on_dorsum(d, random);
  const Vec3 anchor = at + Vec3(-0.01, 0.03, 0.01);
  HiddenChange c;
  c.effect = "tether", c.in_library = false, c.symmetric = false, c.drawn = true, c.first = 30,
  c.most = 3000;
  c.truth = c.shipped = [](ModelDescription t, double) { return t; };
  c.by_hand = [=](const Model& m, double s) {
    ModelParts parts = m.parts();
    parts.effects.push_back(
        std::make_shared<Tether>(m.mesh, at, 0.009, anchor, 0.8 * (anchor - at).norm(), s));
    return Model(std::move(parts));
  };
  c.parameters = [](double) { return Table{}; };
  return c;
}

}  // namespace

const std::vector<std::string>& hidden_names() {
  static const std::vector<std::string> names = {"palate_contact",
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
  return names;
}

HiddenChange hidden_change(const std::string& name, const ModelDescription& tongue,
                           const std::vector<std::string>& active, bool forces_known,
                           std::mt19937& random) {
  if (name == "palate_contact") return contact(name, {0, 0, -1});
  if (name == "jaw_contact") return contact(name, {1, 0, 0});
  if (name == "gravity")
    return by_table(
        name,
        [](double s) {
          return Table{{"x", 0}, {"y", 0}, {"z", -9.81 * s}};
        },
        1, 2);
  if (name == "active_stiffening") return by_number(name, "factor", 1, 1, 9, 90);
  if (name == "fibre_anisotropy") return by_number(name, "modulus", 0, 1e3, 4, 200);
  if (name == "material_nonlinearity") return by_number(name, "a20", 0, 1e3, 3, 90);
  if (name == "compressibility") return by_number(name, "compliance", 0, 1e-5, 3, 100);
  if (name == "mucosa_layer") return by_number(name, "a10", 0, 1e3, 8, 500);
  if (name == "stiff_region") return stiff_region(tongue, random);
  if (name == "weak_muscle") return weak_muscle(active, forces_known, random);
  if (name == "extra_muscle") return extra_muscle(tongue, random);
  if (name == "force_length") return by_number(name, "strength", 0, 1, 0.5, 1);
  if (name == "jaw_opening") return by_number(name, "angle", 0, 1, 2, 20);
  if (name == "hyoid_mobility") return by_number(name, "compliance_z", 0, 1e-3, 1, 100);
  if (name == "airway_pressure") return by_number(name, "pressure", 0, 100, 2, 40);
  if (name == "head_pose") return head_pose(random);
  if (name == "lump") return lump(tongue, random);
  if (name == "tether") return tether(tongue, random);
  throw std::invalid_argument("no such hidden change: " + name);
}

}  // namespace genio::bench
