#include "discrepancy/candidates/symmetric_part.hpp"

#include "forward/model/build_model.hpp"
#include "forward/model/mirror.hpp"

namespace genio {
namespace {

bool has_mirror(const ModelDescription& d) { return mirror_of(build_model(d, d.name)) != nullptr; }

/// Keys that differ by their side alone get their mean.
EffectTable evened(EffectTable table) {
  for (auto& [key, value] : table) {
    const std::string both = bilateral_name(key);
    if (both == key) continue;
    double sum = 0;
    for (const char* side : {"_L", "_R"})
      if (const auto k = table.find(both + side); k != table.end()) sum += 0.5 * k->second;
    for (const char* side : {"_L", "_R"}) table[both + side] = sum;
  }
  return table;
}

}  // namespace

ModelDescription symmetric_part(const ModelDescription& description,
                                const std::vector<Candidate>& effects) {
  if (has_mirror(description)) return description;
  ModelDescription d = description;
  for (const Candidate& c : effects)
    if (c.hypothesis) d.effects[c.effect] = evened(d.effects[c.effect]);
  if (d.effects != description.effects && has_mirror(d)) return d;
  for (const Candidate& c : effects) {
    if (!c.hypothesis) continue;
    const auto without = [&](const std::vector<FreeNumber>& numbers) {
      ModelDescription w = d;
      for (const FreeNumber& n : numbers)
        for (const std::string& key : n.keys) w.effects[c.effect][key] = n.info.absent;
      return w;
    };
    for (const FreeNumber& n : c.strengths)
      if (ModelDescription w = without({n}); has_mirror(w)) return w;
    if (ModelDescription w = without(c.strengths); has_mirror(w)) return w;
    d.effects.erase(c.effect);
  }
  return has_mirror(d) ? d : description;
}

}  // namespace genio
