#include <fmt/format.h>

#include <algorithm>

#include "forward/effects/contact.hpp"
#include "forward/effects/elasticity.hpp"
#include "forward/effects/gravity.hpp"
#include "forward/effects/muscles.hpp"
#include "forward/model_file.hpp"
#include "forward/nearest_name.hpp"

namespace genio {
namespace {

constexpr double field_spacing = 2e-3;    // [m]
constexpr double deepest_overlap = 2e-3;  // at rest [m]
constexpr double field_reach = 0.02;      // how far from its rest shape the tongue can touch [m]

/// Takes values out of an effect's table and complains about what is left.
class TableReader {
 public:
  TableReader(const std::string& source, std::string effect, const EffectTable& table)
      : source_(source), effect_(std::move(effect)), table_(table) {}

  double take(const std::string& key, double fallback) {
    asked_.push_back(key);
    const auto it = table_.find(key);
    return it == table_.end() ? fallback : it->second;
  }
  void finish() const {
    for (const auto& [key, value] : table_)
      if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
        throw InputError(fmt::format("{}: [effect.{}] has no parameter '{}'; did you mean {}?",
                                     source_, effect_, key, nearest_name(key, asked_)));
  }

 private:
  const std::string& source_;
  std::string effect_;
  const EffectTable& table_;
  std::vector<std::string> asked_;
};

std::shared_ptr<const DistanceField> distance_field(const TriangleSurface& surface,
                                                    const HexMesh& mesh) {
  Vec3 low = mesh.nodes[0], high = low, s_low = surface.vertices[0], s_high = s_low;
  for (const Vec3& x : mesh.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  for (const Vec3& x : surface.vertices) s_low = s_low.cwiseMin(x), s_high = s_high.cwiseMax(x);
  const Vec3 reach = Vec3::Constant(field_reach);
  low = (low - reach).cwiseMax(s_low - 0.5 * reach);
  high = (high + reach).cwiseMin(s_high + 0.5 * reach);
  high = high.cwiseMax(low + Vec3::Constant(4 * field_spacing));
  return std::make_shared<DistanceField>(surface, low, high, field_spacing, mesh.nodes);
}

std::shared_ptr<const Effect> make_contact(const std::string& name,
                                           const std::optional<TriangleSurface>& surface,
                                           const ModelDescription& d, const std::string& source,
                                           double stiffness) {
  if (!surface)
    throw InputError(fmt::format("{}: [effect.{}] needs a surface '{}' in [surfaces]", source, name,
                                 name.substr(0, name.find('_'))));
  const auto field = distance_field(*surface, d.mesh);
  const auto area = nodal_areas(d.mesh, boundary_quads(d.mesh));
  std::vector<ContactNode> nodes;
  for (size_t a = 0; a < area.size(); ++a) {
    const double gap = field->value(d.mesh.nodes[a]);
    // Far behind the surface: another side of it (the floor of the mouth lies behind the pharynx).
    if (area[a] > 0 && d.supports[a] == Support::free && gap > -deepest_overlap)
      nodes.push_back({int(a), area[a], std::min(0.0, gap)});
  }
  return std::make_shared<Contact>(name, field, std::move(nodes), stiffness);
}

std::shared_ptr<const Effect> make_effect(const std::string& name, const EffectTable& table,
                                          const ModelDescription& d, const std::string& source) {
  TableReader read(source, name, table);
  std::shared_ptr<const Effect> effect;
  if (name == "elasticity") {
    TissueConstants c;
    c.a10 = read.take("a10", c.a10);
    c.a20 = read.take("a20", c.a20);
    c.kappa = read.take("kappa", 1000 * c.a10);
    effect = std::make_shared<Elasticity>(d.mesh, c);
  } else if (name == "gravity") {
    const double x = read.take("x", 0), y = read.take("y", 0), z = read.take("z", -9.81);
    effect = std::make_shared<Gravity>(d.mesh, d.density, Vec3(x, y, z));
  } else if (name == "palate_contact") {
    effect = make_contact(name, d.palate, d, source, read.take("stiffness", 2e8));
  } else if (name == "jaw_contact") {
    effect = make_contact(name, d.jaw, d, source, read.take("stiffness", 2e8));
  } else {
    throw InputError(fmt::format("{}: [effect.{}] is no effect; did you mean {}?", source, name,
                                 nearest_name(name, effect_names())));
  }
  read.finish();
  for (const auto& info : effect->parameters())
    if (!(info.value >= info.lower && info.value <= info.upper))
      throw InputError(fmt::format("{}: [effect.{}] {} = {}; expected {} to {} {}", source, name,
                                   info.name, info.value, info.lower, info.upper, info.unit));
  return effect;
}

}  // namespace

const std::vector<std::string>& effect_names() {
  static const std::vector<std::string> names = {"elasticity", "muscles", "palate_contact",
                                                 "jaw_contact", "gravity"};
  return names;
}

Model build_model(const ModelDescription& d, const std::string& source) {
  check_mesh(d.mesh, source);
  Model model;
  model.name = d.name;
  model.mesh = d.mesh;
  model.supports = d.supports;
  model.muscles = d.muscles;
  model.landmarks = d.landmarks;
  model.midsagittal = d.midsagittal;
  model.palate = d.palate, model.jaw = d.jaw, model.hyoid = d.hyoid;
  if (!d.effects.contains("elasticity"))
    throw InputError(source + ": [effect.elasticity] is missing; tissue needs a10, a20 and kappa");
  for (auto& muscle : model.muscles)
    muscle.segments = share_by_volume(d.mesh, muscle.fibres, muscle.elements);
  for (const auto& [name, table] : d.effects)
    if (name != "muscles") model.effects.push_back(make_effect(name, table, d, source));
  model.effects.push_back(std::make_shared<Muscles>(model.muscles));
  model.finish();
  if (std::none_of(d.supports.begin(), d.supports.end(),
                   [](Support s) { return s == Support::fixed; }))
    throw InputError(source + ": no node is fixed to the jaw; the tongue would float away");
  return model;
}

Model read_model(const std::string& path) { return build_model(read_description(path), path); }

}  // namespace genio
