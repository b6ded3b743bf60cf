#include "forward/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/effects/contact.hpp"
#include "forward/nearest_name.hpp"

namespace genio {

void Model::finish() {
  rest = rest_positions(mesh);
  surface = boundary_quads(mesh);
  dofs = DofMap(supports);
  std::vector<std::pair<int, int>> extra;
  parameters.clear();
  first_parameter.clear();
  for (size_t e = 0; e < effects.size(); ++e) {
    const auto pairs = effects[e]->couplings();
    extra.insert(extra.end(), pairs.begin(), pairs.end());
    first_parameter.push_back(int(parameters.size()));
    const auto infos = effects[e]->parameters();
    for (size_t k = 0; k < infos.size(); ++k)
      parameters.push_back(
          {int(e), int(k), fmt::format("{}.{}", effects[e]->name(), infos[k].name), infos[k]});
  }
  pattern = BlockPattern(mesh, extra);
}

Parameters default_parameters(const Model& model) {
  Parameters p(model.parameters.size());
  for (size_t k = 0; k < model.parameters.size(); ++k) p[k] = model.parameters[k].info.value;
  return p;
}

int parameter_index(const Model& model, const std::string& name) {
  std::vector<std::string> known;
  for (size_t k = 0; k < model.parameters.size(); ++k) {
    if (model.parameters[k].name == name) return int(k);
    known.push_back(model.parameters[k].name);
  }
  throw InputError(fmt::format("{}: the model has no such parameter; did you mean {}?", name,
                               nearest_name(name, known)));
}

std::vector<int> command_parameters(const Model& model, const std::string& name) {
  std::vector<int> result;
  std::vector<std::string> known;
  for (size_t k = 0; k < model.parameters.size(); ++k) {
    const auto& slot = model.parameters[k];
    if (model.effects[slot.effect]->name() != "muscles") continue;
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
  for (const auto& e : model.effects)
    if (e->name() == name) return e.get();
  return nullptr;
}

EffectParameters effect_parameters(const Model& model, const Parameters& p, int effect) {
  return {p.data() + model.first_parameter[effect], model.effects[effect]->parameters().size()};
}

double energy(const Model& model, const Positions& x, const Parameters& p) {
  double total = 0;
  for (size_t e = 0; e < model.effects.size() && std::isfinite(total); ++e)
    total += model.effects[e]->energy(x, effect_parameters(model, p, int(e)));
  return total;
}

Forces force(const Model& model, const Positions& x, const Parameters& p) {
  Forces f = Forces::Zero(x.size());
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_force(x, effect_parameters(model, p, int(e)), f);
  return f;
}

void stiffness(const Model& model, const Positions& x, const Parameters& p, Stiffness& k) {
  k.set_zero();
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_stiffness(x, effect_parameters(model, p, int(e)), k);
}

void step_stiffness(const Model& model, const Positions& x, const Positions& previous,
                    const Vector& step, const Parameters& p, Stiffness& k) {
  k.set_zero();
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_step_stiffness(x, previous, step, effect_parameters(model, p, int(e)), k);
}

double step_limit(const Model& model, const Positions& x, const Positions& along) {
  double t = 1.0;
  for (const auto& e : model.effects) t = std::min(t, e->step_limit(x, along));
  return t;
}

Matrix force_derivatives(const Model& model, const Positions& x, const Parameters& p,
                         std::span<const int> parameters) {
  Matrix result(x.size(), Eigen::Index(parameters.size()));
  for (size_t c = 0; c < parameters.size(); ++c) {
    const auto& slot = model.parameters[parameters[c]];
    Forces column = Forces::Zero(x.size());
    model.effects[slot.effect]->add_force_derivative(x, effect_parameters(model, p, slot.effect),
                                                     slot.index, column);
    result.col(Eigen::Index(c)) = column;
  }
  return result;
}

double max_penetration(const Model& model, const Positions& x) {
  double depth = 0;
  for (const auto& e : model.effects)
    if (const auto* contact = dynamic_cast<const Contact*>(e.get()))
      depth = std::max(depth, contact->max_penetration(x));
  return depth;
}

}  // namespace genio
