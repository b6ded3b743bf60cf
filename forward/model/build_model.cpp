#include "forward/model/build_model.hpp"

#include <algorithm>

#include "forward/model/build_effects.hpp"

namespace genio {

Model build_model(const ModelDescription& d, const std::string& source) {
  check_mesh(d.mesh, source);
  ModelParts model;
  model.name = d.name;
  model.description = std::make_shared<const ModelDescription>(d);
  model.mesh = d.mesh;
  model.supports = supports_for(d);
  model.muscles = d.muscles;
  model.landmarks = d.landmarks;
  model.midsagittal = d.midsagittal;
  model.palate = d.palate, model.jaw = d.jaw, model.hyoid = d.hyoid;
  if (!d.effects.contains("elasticity"))
    throw InputError(source + ": [effect.elasticity] is missing; tissue needs a10, a20 and kappa");
  for (auto& muscle : model.muscles)
    muscle.segments = share_by_volume(d.mesh, muscle.fibres, muscle.elements);
  model.tissue_mass = tissue_mass(d.mesh, d.density);
  const Anatomy anatomy{d, source, model.muscles, model.supports, model.tissue_mass};
  model.effects = make_effects(anatomy);
  if (std::none_of(d.supports.begin(), d.supports.end(),
                   [](Support s) { return s == Support::fixed; }))
    throw InputError(source + ": no node is fixed to the jaw; the tongue would float away");
  return Model(std::move(model));
}

Model read_model(const std::string& path) { return build_model(read_description(path), path); }

}  // namespace genio
