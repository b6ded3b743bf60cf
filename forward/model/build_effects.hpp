#pragma once
// Effects by name, from what a model file says of them.

#include "forward/base/settings.hpp"
#include "forward/effects/description.hpp"
#include <memory>

#include "forward/effects/effect.hpp"

namespace genio {

/// Every effect name a model file may use. "muscles" is always there.
const std::vector<std::string>& effect_names();

/// What effects are made from: the description with the muscles' segments, and what several need.
struct Anatomy {
  const ModelDescription& description;
  const std::string& source;      ///< named in errors
  std::vector<Muscle> muscles;    ///< with segments
  std::vector<Support> supports;  ///< as the effects present want them
  NodeMatrix mass;                ///< of the tissue
};

/// The supports of a model with these effects: opening jaws and mobile hyoids are unknowns.
std::vector<Support> supports_for(const ModelDescription& description);

/// A place where an effect may be, and the table that puts it there.
struct Place {
  std::string name;
  EffectTable table;
};

/// The places of an effect that needs one; a nameless one for others.
std::vector<Place> places_of(const std::string& effect, const ModelDescription& description);

/// Makes the effect `name` from its table. Throws InputError naming what is wrong.
std::shared_ptr<const Effect> make_effect(const std::string& name, const EffectTable& table,
                                          const Anatomy& anatomy);

}  // namespace genio
