#pragma once
// The list of effects: a line here, and the battery of laws, the search for missing effects and the
// benchmark know of it.

#include "forward/effects/kind.hpp"

namespace genio {

/// Every effect there is.
const std::vector<EffectKind>& effect_kinds();

/// By its name; null: there is none.
const EffectKind* find_kind(const std::string& name);

}  // namespace genio
