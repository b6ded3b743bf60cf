#include "forward/model/hypothesis.hpp"

#include <algorithm>

#include "forward/model/build_effects.hpp"

namespace genio {
namespace {

FreeNumber free_number(const Strength& way, const std::vector<int>& parameters,
                       std::span<const ParameterInfo> info) {
  FreeNumber n{"", {}, info[size_t(parameters.front())]};
  n.info.lower = std::max(n.info.lower, n.info.least);
  n.info.upper = std::min(n.info.upper, n.info.most);
  for (int k : parameters) n.keys.push_back(info[size_t(k)].name);
  n.name = way.where.empty() ? n.keys.front() : way.where;
  return n;
}

/// Hypotheses of one effect at one place.
void add(const ModelDescription& d, const std::string& name, const Place& place,
         const Anatomy& anatomy, std::vector<Hypothesis>& result) {
  std::shared_ptr<const Effect> sample;
  const auto present = d.effects.find(name);
  EffectTable table = present == d.effects.end() ? place.table : present->second;
  try {
    sample = make_effect(name, table, anatomy);
  } catch (const InputError&) {
    return;  // no surface to touch, no hyoid to move
  }
  const auto info = sample->parameters();
  std::vector<FreeNumber> details;
  for (size_t k = 0; k < info.size(); ++k)
    if (info[k].detail) details.push_back({info[k].name, {info[k].name}, info[k]});
  const auto ways = sample->strengths();
  const auto absent = [&](const Strength& way) {
    for (const auto& parameters : way.numbers)
      for (int k : parameters)
        if (info[size_t(k)].value != info[size_t(k)].absent) return false;
    return true;
  };
  EffectTable vanished = table;
  if (present == d.effects.end())
    for (const Strength& way : ways)
      for (const auto& parameters : way.numbers)
        for (int k : parameters) vanished[info[size_t(k)].name] = info[size_t(k)].absent;
  const auto made = make_effect(name, vanished, anatomy);
  for (const Strength& way : ways) {
    if (present != d.effects.end() && !absent(way)) continue;
    Hypothesis h{name, way.where.empty() ? place.name : way.where, vanished, {}, details, made};
    if (h.where.empty() && ways.size() > 1)
      h.where = info[size_t(way.numbers.front().front())].name;
    for (const auto& parameters : way.numbers)
      h.strengths.push_back(free_number(way, parameters, info));
    result.push_back(std::move(h));
  }
}

}  // namespace

std::string label(const std::string& effect, const std::string& where) {
  return where.empty() ? effect : effect + " (" + where + ")";
}

bool Hypothesis::is_switch() const {
  return std::all_of(strengths.begin(), strengths.end(),
                     [](const FreeNumber& n) { return n.info.penalty; });
}

ModelDescription Hypothesis::added_to(ModelDescription d, bool present) const {
  EffectTable t = table;
  if (present)
    for (const FreeNumber& n : strengths)
      for (const auto& key : n.keys)
        if (n.info.penalty) t[key] = n.info.absent + n.info.typical;
  d.effects[effect] = std::move(t);
  return d;
}

ModelDescription with_mobile_supports(ModelDescription d) {
  for (const std::string& name : effect_names()) {
    if (d.effects.contains(name)) continue;
    ModelDescription with = d;
    with.effects[name] = {};
    if (supports_for(with) == supports_for(d)) continue;
    for (const Hypothesis& h : hypotheses(d))
      if (h.effect == name) {
        d = h.added_to(d);
        break;
      }
  }
  return d;
}

std::vector<Hypothesis> hypotheses(const ModelDescription& d) {
  const std::string source = d.name;
  std::vector<Muscle> muscles = d.muscles;
  for (Muscle& m : muscles) m.segments = share_by_volume(d.mesh, m.fibres, m.elements);
  const NodeMatrix mass = tissue_mass(d.mesh, d.density);
  std::vector<Hypothesis> result;
  for (const std::string& name : effect_names()) {
    const auto places = places_of(name, d);
    const bool placed = places.size() > 1 || !places.front().name.empty();
    if (d.effects.contains(name) && placed) continue;
    ModelDescription with = d;
    with.effects.try_emplace(name);
    const Anatomy anatomy{d, source, muscles, supports_for(with), mass};
    for (const Place& place : places) add(d, name, place, anatomy, result);
  }
  return result;
}

}  // namespace genio
