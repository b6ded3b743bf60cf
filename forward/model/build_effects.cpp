#include "forward/model/build_effects.hpp"

#include <fmt/format.h>

#include "forward/base/nearest_name.hpp"
#include "forward/model/effect_kinds.hpp"

namespace genio {

const std::vector<std::string>& effect_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n;
    for (const EffectKind& kind : effect_kinds()) n.push_back(kind.name);
    return n;
  }();
  return names;
}

std::vector<Support> supports_for(const ModelDescription& d) {
  std::vector<Support> supports = d.supports;
  for (const EffectKind& kind : effect_kinds())
    if (kind.support && d.effects.contains(kind.name))
      for (Support& s : supports) s = kind.support(s);
  return supports;
}

Effect make_effect(const std::string& name, const EffectTable& table, const Anatomy& anatomy) {
  const EffectKind* kind = find_kind(name);
  if (!kind)
    throw InputError(fmt::format("{}: [effect.{}] is no effect; did you mean {}?", anatomy.source,
                                 name, nearest_name(name, effect_names())));
  Settings settings(anatomy.source, name, table);
  Effect effect = kind->make(settings, anatomy);
  settings.finish();
  for (const ParameterInfo& info : effect.parameters())
    if (!(info.value >= info.lower && info.value <= info.upper))
      throw InputError(fmt::format("{}: [effect.{}] {} = {}; expected {} to {} {}", anatomy.source,
                                   name, info.name, info.value, info.lower, info.upper, info.unit));
  return effect;
}

std::vector<Effect> make_effects(const Anatomy& anatomy) {
  std::vector<Effect> effects;
  for (const auto& [name, table] : anatomy.description.effects)
    if (const EffectKind* kind = find_kind(name); !kind || !kind->always)
      effects.push_back(make_effect(name, table, anatomy));
  for (const EffectKind& kind : effect_kinds())
    if (kind.always) effects.push_back(make_effect(kind.name, {}, anatomy));
  return effects;
}

}  // namespace genio
