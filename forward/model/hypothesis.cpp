#include "forward/model/hypothesis.hpp"

#include <algorithm>
#include <cmath>

#include "forward/model/build_effects.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/effect_kinds.hpp"

namespace genio {
namespace {

/// An effect as one way of putting it into a model makes it.
struct Sample {
  EffectTable table;
  std::vector<ParameterInfo> info;
  std::vector<ParameterBelief> beliefs;

  FreeNumber number(int k) const {
    return {info[size_t(k)].name, {info[size_t(k)].name}, info[size_t(k)], beliefs[size_t(k)]};
  }
  bool is_absent(const Variant& variant) const {
    for (const auto& parameters : variant.numbers)
      for (int k : parameters)
        if (info[size_t(k)].value != info[size_t(k)].absent) return false;
    return true;
  }
};

FreeNumber strength(const Variant& variant, const std::vector<int>& parameters, const Sample& s) {
  FreeNumber n = s.number(parameters.front());
  n.info.lower = std::max(n.info.lower, n.belief.least);
  n.info.upper = std::min(n.info.upper, n.belief.most);
  n.keys.clear();
  for (int k : parameters) n.keys.push_back(s.info[size_t(k)].name);
  if (!variant.where.empty()) n.name = variant.where;
  return n;
}

/// Hypotheses of one effect at one place.
void add(const ModelDescription& d, const EffectKind& kind, const Place& place,
         const Anatomy& anatomy, std::vector<Hypothesis>& result) {
  const auto present = d.effects.find(kind.name);
  Sample s{present == d.effects.end() ? place.table : present->second, {}, {}};
  try {
    s.info = make_effect(kind.name, s.table, anatomy).parameters();
  } catch (const InputError&) {
    return;  // no surface to touch, no hyoid to move
  }
  s.beliefs = beliefs_of(kind.belief, s.info);
  std::vector<FreeNumber> details;
  for (size_t k = 0; k < s.info.size(); ++k)
    if (s.beliefs[k].detail) details.push_back(s.number(int(k)));
  const auto variants = variants_of(kind.belief, s.info);
  EffectTable vanished = s.table;
  if (present == d.effects.end())
    for (const Variant& variant : variants)
      for (const auto& parameters : variant.numbers)
        for (int k : parameters) vanished[s.info[size_t(k)].name] = s.info[size_t(k)].absent;
  const Effect made = make_effect(kind.name, vanished, anatomy);
  for (const Variant& variant : variants) {
    if (present != d.effects.end() && !s.is_absent(variant)) continue;
    Hypothesis h{
        kind.name, variant.where.empty() ? place.name : variant.where, vanished, {}, details, made};
    if (h.where.empty() && variants.size() > 1)
      h.where = s.info[size_t(variant.numbers.front().front())].name;
    for (const auto& parameters : variant.numbers)
      h.strengths.push_back(strength(variant, parameters, s));
    result.push_back(std::move(h));
  }
}

}  // namespace

double FreeNumber::off(double value) const {
  return belief.ratio ? std::log(value) : value - info.absent;
}

double FreeNumber::at(double off) const { return belief.ratio ? std::exp(off) : info.absent + off; }

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
        if (n.info.penalty) t[key] = n.info.absent + n.belief.typical;
  d.effects[effect] = std::move(t);
  return d;
}

std::string implausible(const std::string& effect, EffectParameters values) {
  const EffectKind* kind = find_kind(effect);
  return kind && kind->belief.implausible ? kind->belief.implausible(values) : "";
}

ModelDescription with_mobile_supports(ModelDescription d) {
  for (const EffectKind& kind : effect_kinds()) {
    if (d.effects.contains(kind.name)) continue;
    ModelDescription with = d;
    with.effects[kind.name] = {};
    if (supports_for(with) == supports_for(d)) continue;
    for (const Hypothesis& h : hypotheses(d))
      if (h.effect == kind.name) {
        d = h.added_to(d);
        break;
      }
  }
  return d;
}

std::vector<Hypothesis> hypotheses(const ModelDescription& d) {
  const std::string source = d.name;
  Anatomy anatomy = anatomy_of(d, source);
  std::vector<Hypothesis> result;
  for (const EffectKind& kind : effect_kinds()) {
    if (d.effects.contains(kind.name) && kind.places) continue;
    ModelDescription with = d;
    with.effects.try_emplace(kind.name);
    anatomy.supports = supports_for(with);
    const auto places = kind.places ? kind.places(d) : std::vector<Place>{{}};
    for (const Place& place : places) add(d, kind, place, anatomy, result);
  }
  return result;
}

}  // namespace genio
