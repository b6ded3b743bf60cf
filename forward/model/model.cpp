#include "forward/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/base/nearest_name.hpp"
#include "forward/effects/surroundings/contact.hpp"

namespace genio {

namespace {

using Effects = std::vector<std::shared_ptr<const Effect>>;

int index_of(const std::vector<ParameterSlot>& slots, const std::string& name) {
  std::vector<std::string> known;
  for (size_t k = 0; k < slots.size(); ++k) {
    known.push_back(slots[k].name.text());
    if (known.back() == name) return int(k);
  }
  throw InputError(fmt::format("{}: the model has no such parameter; did you mean {}?", name,
                               nearest_name(name, known)));
}

std::vector<ParameterSlot> parameter_slots(const Effects& effects) {
  std::vector<ParameterSlot> slots;
  for (size_t e = 0; e < effects.size(); ++e) {
    const std::string effect(effects[e]->name());
    const auto infos = effects[e]->parameters();
    for (size_t k = 0; k < infos.size(); ++k)
      slots.push_back({.effect = int(e),
                       .index = int(k),
                       .name = {effect, infos[k].name},
                       .info = infos[k],
                       .is_command = effect == "muscles"});
  }
  return slots;
}

std::vector<std::vector<int>> inputs_of(const Effects& effects,
                                        const std::vector<ParameterSlot>& slots) {
  std::vector<std::vector<int>> inputs(effects.size());
  for (size_t k = 0; k < slots.size(); ++k) inputs[size_t(slots[k].effect)].push_back(int(k));
  for (size_t e = 0; e < effects.size(); ++e)
    for (const auto& borrowed : effects[e]->borrows())
      inputs[e].push_back(index_of(slots, borrowed));
  return inputs;
}

std::shared_ptr<const BlockPattern> pattern_of(const HexMesh& mesh, const Effects& effects) {
  std::vector<std::pair<int, int>> extra;
  for (const auto& effect : effects) {
    const auto pairs = effect->couplings();
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
      tissue_mass(std::move(from.tissue_mass)),
      rest(rest_positions(mesh)),
      surface(boundary_quads(mesh)),
      batches(element_batches(mesh)),
      dofs(supports),
      parameters(parameter_slots(effects)),
      inputs(inputs_of(effects, parameters)),
      pattern(pattern_of(mesh, effects)) {}

ModelParts Model::parts() const {
  return {name,        description, mesh, supports, muscles, landmarks,
          midsagittal, palate,      jaw,  hyoid,    effects, tissue_mass};
}

Parameters default_parameters(const Model& model) {
  Parameters p(model.parameters.size());
  for (size_t k = 0; k < model.parameters.size(); ++k) p[k] = model.parameters[k].info.value;
  return p;
}

int parameter_index(const Model& model, const std::string& name) {
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
  for (const auto& e : model.effects)
    if (e->name() == name) return e.get();
  return nullptr;
}

std::vector<double> effect_parameters(const Model& model, const Parameters& p, int effect) {
  std::vector<double> values;
  for (int k : model.inputs[size_t(effect)]) values.push_back(p[k]);
  return values;
}

double energy(const Model& model, const Positions& x, const Parameters& p) {
  double total = 0;
  for (size_t e = 0; e < model.effects.size() && std::isfinite(total); ++e)
    total += model.effects[e]->energy(x, effect_parameters(model, p, int(e)));
  return total;
}

Forces forces_of(const Model& model, const Positions& x, const Parameters& p,
                 const std::function<bool(const Effect&)>& which) {
  Forces f = Forces::Zero(x.size());
  for (size_t e = 0; e < model.effects.size(); ++e)
    if (which(*model.effects[e]))
      model.effects[e]->add_force(x, effect_parameters(model, p, int(e)), f);
  return f;
}

Forces force(const Model& model, const Positions& x, const Parameters& p) {
  return forces_of(model, x, p, [](const Effect&) { return true; });
}

double load_size(const Model& model, const Positions& x, const Parameters& p) {
  constexpr double floor = 1e-3;  // [N]
  Forces f;
  double sum = 0;
  for (size_t e = 0; e < model.effects.size(); ++e) {
    const auto infos = model.effects[e]->parameters();
    if (std::none_of(infos.begin(), infos.end(),
                     [](const ParameterInfo& i) { return i.load || i.penalty; }))
      continue;
    f = Forces::Zero(x.size());
    model.effects[e]->add_force(x, effect_parameters(model, p, int(e)), f);
    sum += f.squaredNorm();
  }
  return std::max(std::sqrt(sum), floor);
}

void stiffness(const Model& model, const Positions& x, const Parameters& p, Stiffness& k) {
  k.set_zero();
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_stiffness(x, effect_parameters(model, p, int(e)), k);
}

void step_stiffness(const Model& model, const Positions& x, const LinearStep& led,
                    const Parameters& p, Stiffness& k) {
  k.set_zero();
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_step_stiffness(x, led, effect_parameters(model, p, int(e)), k);
}

Bulk bulk(const Model& model, const Positions& x, const Parameters& p) {
  Vector kappa = Vector::Zero(Eigen::Index(model.mesh.elements.size()));
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_bulk_modulus(effect_parameters(model, p, int(e)), kappa);
  Bulk result{VolumeGradients(model.batches, x), {}, {}, Vector(kappa.size())};
  for (const ElementBatch& batch : model.batches)
    for (int l = 0; l < batch.count; ++l) result.volume[batch.element[l]] = batch.volume[l];
  result.stiffness = kappa.cwiseQuotient(result.volume);
  // Volumes are homogeneous of third degree in the positions (Euler).
  result.excess = result.gradients.rates(x) / 3 - result.volume;
  return result;
}

double step_limit(const Model& model, const Positions& x, const Positions& along,
                  const Parameters& p) {
  double t = 1.0;
  for (size_t e = 0; e < model.effects.size(); ++e)
    t = std::min(t, model.effects[e]->step_limit(x, along, effect_parameters(model, p, int(e))));
  return t;
}

Forces forces_in_motion(const Model& model, const Positions& x, const Vector& v,
                        const Parameters& p, Forces& viscous) {
  Forces f = Forces::Zero(x.size());
  viscous = f;
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_forces_in_motion(x, v, effect_parameters(model, p, int(e)), f, viscous);
  return f;
}

void add_damping(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                 double scale, Stiffness& scratch, Stiffness& k) {
  scratch.set_zero();
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_damping(x, v, effect_parameters(model, p, int(e)), scratch);
  k.add(scratch, scale);
}

NodeMatrix mass_matrix(const Model& model, const Parameters& p) {
  if (model.tissue_mass.size() == 0)
    throw InputError(model.name + ": the model has no mass; dynamics needs its density");
  Vector points = Vector::Zero(model.tissue_mass.rows());
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_mass(effect_parameters(model, p, int(e)), points);
  NodeMatrix mass = model.tissue_mass;
  mass.diagonal() += points;
  return mass;
}

namespace {

/// add(effect, its values, its parameter, column) for every effect that reads one of `parameters`.
template <class Add>
Matrix sum_of_derivatives(const Model& model, Eigen::Index size, const Parameters& p,
                          std::span<const int> parameters, Add add) {
  Matrix result = Matrix::Zero(size, Eigen::Index(parameters.size()));
  Forces column;
  for (size_t e = 0; e < model.effects.size(); ++e) {
    const auto& inputs = model.inputs[e];
    const auto values = effect_parameters(model, p, int(e));
    for (size_t c = 0; c < parameters.size(); ++c)
      for (size_t k = 0; k < inputs.size(); ++k) {
        if (inputs[k] != parameters[c]) continue;
        column = Forces::Zero(size);
        add(*model.effects[e], values, int(k), column);
        result.col(Eigen::Index(c)) += column;
      }
  }
  return result;
}

}  // namespace

Matrix force_derivatives(const Model& model, const Positions& x, const Parameters& p,
                         std::span<const int> parameters) {
  return sum_of_derivatives(model, x.size(), p, parameters,
                            [&](const Effect& e, EffectParameters values, int k, Forces& df) {
                              e.add_force_derivative(x, values, k, df);
                            });
}

Matrix motion_force_derivatives(const Model& model, const Positions& x, const Vector& v,
                                const Parameters& p, std::span<const int> parameters) {
  return sum_of_derivatives(model, x.size(), p, parameters,
                            [&](const Effect& e, EffectParameters values, int k, Forces& df) {
                              e.add_force_derivative(x, values, k, df);
                              e.add_viscous_force_derivative(x, v, values, k, df);
                            });
}

Matrix viscous_slope(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                     const Matrix& along, Stiffness& scratch) {
  Matrix df = Matrix::Zero(along.rows(), along.cols());
  for (size_t e = 0; e < model.effects.size(); ++e)
    model.effects[e]->add_viscous_force_slope(x, v, effect_parameters(model, p, int(e)), along,
                                              scratch, df);
  return df;
}

double max_penetration(const Model& model, const Positions& x, const Parameters& p) {
  double depth = 0;
  for (size_t e = 0; e < model.effects.size(); ++e)
    if (const auto* contact = dynamic_cast<const Contact*>(model.effects[e].get()))
      depth = std::max(depth, contact->max_penetration(x, effect_parameters(model, p, int(e))));
  return depth;
}

}  // namespace genio
