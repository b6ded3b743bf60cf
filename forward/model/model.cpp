#include "forward/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/base/nearest_name.hpp"
#include "forward/model/at_anatomy.hpp"

namespace genio {

namespace {

int index_of(const std::vector<ParameterSlot>& slots, const std::string& name) {
  std::vector<std::string> known;
  for (size_t k = 0; k < slots.size(); ++k) {
    known.push_back(slots[k].name.text());
    if (known.back() == name) return int(k);
  }
  throw InputError(fmt::format("{}: the model has no such parameter; did you mean {}?", name,
                               nearest_name(name, known)));
}

std::vector<ParameterSlot> parameter_slots(const std::vector<Effect>& effects) {
  std::vector<ParameterSlot> slots;
  for (size_t e = 0; e < effects.size(); ++e) {
    const auto infos = effects[e].parameters();
    for (size_t k = 0; k < infos.size(); ++k)
      slots.push_back({.effect = int(e),
                       .index = int(k),
                       .name = {std::string(effects[e].name()), infos[k].name},
                       .info = infos[k],
                       .is_command = effects[e].commands});
  }
  return slots;
}

int index_of(const std::vector<ParameterSlot>& slots, const ParameterName& name) {
  for (size_t k = 0; k < slots.size(); ++k)
    if (slots[k].name == name) return int(k);
  return index_of(slots, name.text());  // which knows what to suggest
}

/// Where what a term of the effect reads stands among the slots.
std::vector<int> inputs_of(const Term& term, const std::vector<ParameterSlot>& slots) {
  std::vector<ParameterName> names;
  for (const ParameterInfo& info : term.parameters())
    names.push_back({std::string(term.name()), info.name});
  const auto borrowed = term.borrows();
  names.insert(names.end(), borrowed.begin(), borrowed.end());
  std::vector<int> inputs;
  for (const ParameterName& name : names) inputs.push_back(index_of(slots, name));
  return inputs;
}

/// The terms of one kind.
template <class T>
std::vector<Placed<T>> placed(const std::vector<Effect>& effects,
                              const std::vector<ParameterSlot>& slots,
                              std::shared_ptr<const T> Effect::*member) {
  std::vector<Placed<T>> result;
  for (size_t e = 0; e < effects.size(); ++e)
    if (const auto& term = effects[e].*member)
      result.push_back({term, int(e), inputs_of(*term, slots)});
  return result;
}

std::vector<Placed<JointForces>> placed_joint(const std::vector<Effect>& effects,
                                              const std::vector<ParameterSlot>& slots) {
  std::vector<Placed<JointForces>> result;
  for (size_t e = 0; e < effects.size(); ++e)
    if (effects[e].joint)
      result.push_back({effects[e].joint, int(e), inputs_of(*effects[e].dissipation, slots)});
  return result;
}

std::shared_ptr<const BlockPattern> pattern_of(const HexMesh& mesh,
                                               const std::vector<Effect>& effects) {
  std::vector<std::pair<int, int>> extra;
  for (const Effect& effect : effects)
    for (const Term* term : effect.terms()) {
      const auto pairs = term->couplings();
      extra.insert(extra.end(), pairs.begin(), pairs.end());
    }
  return std::make_shared<const BlockPattern>(mesh, extra);
}

}  // namespace

Model::Model(ModelParts from)
    : name(std::move(from.name)),
      description(std::move(from.description)),
      mesh(std::move(from.mesh)),
      supports(std::move(from.supports)),
      muscles(std::move(from.muscles)),
      landmarks(from.landmarks),
      midsagittal(std::move(from.midsagittal)),
      palate(std::move(from.palate)),
      jaw(std::move(from.jaw)),
      hyoid(std::move(from.hyoid)),
      effects(std::move(from.effects)),
      tissue_mass(from.tissue_mass),
      is_moved(from.is_moved),
      rest(rest_positions(mesh)),
      surface(boundary_quads(mesh)),
      dofs(supports),
      parameters(parameter_slots(effects)),
      potentials(placed(effects, parameters, &Effect::potential)),
      dissipations(placed(effects, parameters, &Effect::dissipation)),
      joint_forces(placed_joint(effects, parameters)),
      inertias(placed(effects, parameters, &Effect::inertia)),
      filters(placed(effects, parameters, &Effect::filter)),
      contacts(placed(effects, parameters, &Effect::contact)),
      anatomy(placed(effects, parameters, &Effect::modes)),
      shapes(anatomy.empty() || is_moved ? nullptr : std::make_shared<AnatomyShapes>()),
      pattern(from.pattern ? from.pattern : pattern_of(mesh, effects)),
      batches(std::make_shared<const std::vector<ElementBatch>>(element_batches(mesh))) {}

ModelParts Model::parts() const {
  return {name,   description, mesh,  supports, muscles,     landmarks, midsagittal,
          palate, jaw,         hyoid, effects,  tissue_mass, is_moved};
}

Parameters default_parameters(const Model& model) {
  Parameters p(model.parameters.size());
  for (size_t k = 0; k < model.parameters.size(); ++k) p[k] = model.parameters[k].info.value;
  return p;
}

int parameter_index(const Model& model, const std::string& name) {
  return index_of(model.parameters, name);
}

int parameter_index(const Model& model, const ParameterName& name) {
  return index_of(model.parameters, name);
}

std::vector<int> command_parameters(const Model& model, const std::string& name) {
  std::vector<int> result;
  std::vector<std::string> known;
  for (size_t k = 0; k < model.parameters.size(); ++k) {
    const auto& slot = model.parameters[k];
    if (!slot.is_command) continue;
    const std::string both = bilateral_name(slot.info.name);
    if (slot.info.name == name || both == name) result.push_back(int(k));
    if (both != slot.info.name) known.push_back(both);
    known.push_back(slot.info.name);
  }
  if (result.empty())
    throw InputError(fmt::format("{}: the model has no such muscle; did you mean {}?", name,
                                 nearest_name(name, known)));
  return result;
}

void set_command(const Model& model, const std::string& name, double newtons, Parameters& p) {
  const auto indices = command_parameters(model, name);
  double maximum = 0;
  for (int k : indices) maximum += model.parameters[k].info.upper;
  if (!std::isfinite(newtons) || newtons < 0)
    throw InputError(
        fmt::format("{}: force {} N; expected a number from 0 to {} N", name, newtons, maximum));
  if (newtons > maximum * (1 + 1e-12))
    throw InputError(fmt::format("{}: force {} N is above the muscle's maximum of {} N", name,
                                 newtons, maximum));
  for (int k : indices) p[k] = newtons * model.parameters[k].info.upper / maximum;
}

void set_parameter(const Model& model, const std::string& name, double value, Parameters& p) {
  const int k = parameter_index(model, name);
  const auto& info = model.parameters[k].info;
  if (!std::isfinite(value) || value < info.lower || value > info.upper)
    throw InputError(fmt::format("{}: value {} {}; expected {} to {} {}", name, value, info.unit,
                                 info.lower, info.upper, info.unit));
  p[k] = value;
}

const Effect* find_effect(const Model& model, std::string_view name) {
  for (const Effect& e : model.effects)
    if (e.name() == name) return &e;
  return nullptr;
}

std::vector<double> effect_parameters(const Model& model, const Parameters& p, int effect) {
  std::vector<double> values;
  for (size_t k = 0; k < model.parameters.size(); ++k)
    if (model.parameters[k].effect == effect) values.push_back(p[Eigen::Index(k)]);
  return values;
}

}  // namespace genio
