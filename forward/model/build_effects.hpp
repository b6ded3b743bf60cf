#pragma once
// Effects by name, from what a model file says of them.

#include <string>
#include <vector>

#include "forward/base/settings.hpp"
#include "forward/effects/anatomy.hpp"
#include "forward/effects/effect.hpp"

namespace genio {

/// Every effect name a model file may use.
const std::vector<std::string>& effect_names();

/// The supports of a model with these effects: opening jaws and mobile hyoids are unknowns.
std::vector<Support> supports_for(const ModelDescription& description);

/// Makes the effect `name` from its table. Throws InputError naming what is wrong.
Effect make_effect(const std::string& name, const EffectTable& table, const Anatomy& anatomy);

/// All effects of a description, by their names; those that every model has come last.
std::vector<Effect> make_effects(const Anatomy& anatomy);

}  // namespace genio
