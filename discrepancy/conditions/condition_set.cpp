#include "discrepancy/conditions/condition_set.hpp"

#include <algorithm>

#include "forward/model/build_model.hpp"

namespace genio {
namespace {

constexpr double known_sd = 1e-4;  // activation: as good as fixed, where nothing else is said

std::vector<size_t> where(const Observations& o, bool heldout) {
  std::vector<size_t> result;
  for (size_t k = 0; k < o.conditions.size(); ++k)
    if (o.conditions[k].heldout == heldout) result.push_back(k);
  return result;
}

}  // namespace

ModelDescription with_effects(ModelDescription d, const std::map<std::string, double>& effects) {
  for (const auto& [name, value] : effects) d = with_parameter(std::move(d), name, value);
  return d;
}

std::vector<size_t> fitted_conditions(const Observations& o) { return where(o, false); }
std::vector<size_t> heldout_conditions(const Observations& o) { return where(o, true); }

ConditionSet::ConditionSet(ModelDescription description, const Observations& observations,
                           std::vector<size_t> members)
    : description_(std::move(description)),
      observations_(observations),
      members_(std::move(members)) {
  std::vector<std::map<std::string, double>> known;
  for (size_t k : members_) {
    const auto& effects = observations_.conditions[k].effects;
    const auto at = std::find(known.begin(), known.end(), effects);
    tongue_.push_back(size_t(at - known.begin()));
    if (at != known.end()) continue;
    known.push_back(effects);
    const ModelDescription d = with_effects(description_, effects);
    tongues_.push_back(
        std::make_unique<Tongue>(std::make_unique<const Model>(build_model(d, d.name))));
  }
}

bool ConditionSet::bilateral(size_t k) const {
  return observations_.bilateral && !condition(k).forces.has_value();
}

Prior ConditionSet::prior(size_t k) const {
  Prior prior;
  prior.effort_sd = observations_.effort_sd;
  prior.head_pose = observations_.head_pose;
  if (!condition(k).forces) return prior;
  for (const Muscle& m : model(k).muscles) {
    const auto known = condition(k).forces->find(m.name);
    if (known == condition(k).forces->end() || known->second.mean == 0) prior.fixed[m.name] = 0;
    else
      prior.emg[m.name] = {known->second.mean / m.max_force,
                           std::max(known_sd, known->second.sd / m.max_force)};
  }
  return prior;
}

}  // namespace genio
