#include "forward/model/build_model.hpp"

#include <algorithm>

#include "forward/effects/modes/moved_rest.hpp"
#include "forward/model/build_effects.hpp"

namespace genio {

namespace {

ModelParts parts_of(const ModelDescription& d, const std::string& source,
                    const ModelDescription* standing) {
  check_mesh(d.mesh, source);
  ModelParts model;
  model.name = d.name;
  model.description = std::make_shared<const ModelDescription>(d);
  model.mesh = d.mesh;
  model.supports = supports_for(d);
  model.landmarks = d.landmarks;
  model.midsagittal = d.midsagittal;
  model.palate = d.palate, model.jaw = d.jaw, model.hyoid = d.hyoid;
  if (!d.effects.contains("elasticity"))
    throw InputError(source + ": [effect.elasticity] is missing; tissue needs a10, a20 and kappa");
  const Anatomy anatomy = anatomy_of(d, source, standing);
  model.muscles = anatomy.muscles, model.tissue_mass = anatomy.mass;
  model.effects = make_effects(anatomy);
  if (std::none_of(d.supports.begin(), d.supports.end(),
                   [](Support s) { return s == Support::fixed; }))
    throw InputError(source + ": no node is fixed to the jaw; the tongue would float away");
  return model;
}

}  // namespace

Anatomy anatomy_of(const ModelDescription& d, const std::string& source,
                   const ModelDescription* standing) {
  Anatomy result{d, source, d.muscles, supports_for(d), tissue_mass(d.mesh, d.density), standing};
  for (size_t m = 0; m < d.muscles.size(); ++m) {
    Muscle& muscle = result.muscles[m];
    if (!standing) {
      muscle.segments = share_by_volume(d.mesh, muscle.fibres, muscle.elements);
      continue;
    }
    muscle.segments = segments_of(d.mesh, muscle.fibres);
    const auto shares =
        share_by_volume(standing->mesh, standing->muscles[m].fibres, muscle.elements);
    for (size_t s = 0; s < shares.size(); ++s) muscle.segments[s].share = shares[s].share;
  }
  return result;
}

Model build_model(const ModelDescription& d, const std::string& source) {
  return Model(parts_of(d, source, nullptr));
}

Model moved_model(const Model& model, const std::vector<double>& values) {
  ModelParts parts =
      parts_of(moved(*model.description, values), model.name, model.description.get());
  const auto alike = [](const Effect& a, const Effect& b) { return a.name() == b.name(); };
  if (!std::ranges::equal(parts.effects, model.effects, alike))
    throw InputError(model.name +
                     ": its effects are not those of its description, so that no mode moves it");
  parts.is_moved = true, parts.pattern = model.pattern;
  return Model(std::move(parts));
}

Model read_model(const std::string& path) { return build_model(read_description(path), path); }

}  // namespace genio
