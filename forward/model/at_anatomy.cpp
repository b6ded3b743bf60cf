#include "forward/model/at_anatomy.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "forward/effects/modes/moved_rest.hpp"
#include "forward/model/build_model.hpp"

namespace genio {
namespace {

constexpr size_t most_shapes = 6;    // some 5 MB each
constexpr double tells_less = 1e-9;  // of the most that nodes held by bones tell of a mode

Vector held_part(const DofMap& dofs, const Vector& field) { return field - followed(dofs, field); }

/// The nodal fields of all modes, a column each.
Matrix fields_of(const Model& model) {
  const auto& modes = model.description->modes;
  Matrix fields(model.rest.size(), Eigen::Index(modes.size()));
  for (size_t k = 0; k < modes.size(); ++k) fields.col(Eigen::Index(k)) = nodal_field(modes[k]);
  return fields;
}

}  // namespace

std::shared_ptr<const Model> AnatomyShapes::at(const Model& model,
                                               const std::vector<double>& values) {
  const auto known = [&]() -> std::shared_ptr<const Model> {
    for (const auto& [key, shape] : kept_)
      if (key == values) return shape;
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex_);
    if (auto shape = known()) return shape;
  }
  auto made = std::make_shared<const Model>(moved_model(model, values));
  const std::lock_guard lock(mutex_);
  if (auto shape = known()) return shape;
  kept_.emplace_back(values, made);
  if (kept_.size() > most_shapes) kept_.pop_front();
  return made;
}

std::shared_ptr<const Model> at_anatomy(const Model& model, const Parameters& p) {
  const auto itself = [&] { return std::shared_ptr<const Model>(std::shared_ptr<void>(), &model); };
  if (!model.shapes) return itself();
  const std::vector<double> values = model.anatomy.front().values(p);
  if (std::all_of(values.begin(), values.end(), [](double m) { return m == 0; })) return itself();
  return model.shapes->at(model, values);
}

std::shared_ptr<const Model> at_anatomy(const Model& model) {
  return at_anatomy(model, default_parameters(model));
}

std::map<std::string, double> anatomy_values(const Model& model, const Parameters& p) {
  std::map<std::string, double> result;
  for (const auto& modes : model.anatomy)
    for (const int k : modes.inputs) result[model.parameters[size_t(k)].name.key] = p[k];
  return result;
}

int mode_of(const Model& model, int k) {
  if (!model.shapes) return -1;
  const auto& inputs = model.anatomy.front().inputs;
  const auto at = std::find(inputs.begin(), inputs.end(), k);
  return at == inputs.end() ? -1 : int(at - inputs.begin());
}

int mode_named(const Model& model, const std::string& name) {
  const auto& modes = model.description->modes;
  for (size_t k = 0; k < modes.size(); ++k)
    if (modes[k].name == name) return int(k);
  return -1;
}

Vector followed(const DofMap& dofs, const Vector& field) {
  const Vector nodes = dofs.reduce(Vector::Ones(field.size()));
  return dofs.expand(dofs.reduce(field).cwiseQuotient(nodes));
}

Vector held_by_mode(const Model& model, int mode) {
  return held_part(model.dofs, nodal_field(model.description->modes[size_t(mode)]));
}

Matrix held_motion(const Model& model, std::span<const int> parameters) {
  Matrix result = Matrix::Zero(model.rest.size(), Eigen::Index(parameters.size()));
  for (size_t c = 0; c < parameters.size(); ++c)
    if (const int k = mode_of(model, parameters[c]); k >= 0)
      result.col(Eigen::Index(c)) = held_by_mode(model, k);
  return result;
}

Positions carried(const Model& model, const Positions& shape, const Parameters& p) {
  const auto here = at_anatomy(model, p);
  if (shape == model.rest) return here->rest;
  Positions along = shape;
  if (model.shapes) {
    const Matrix fields = fields_of(model);
    Matrix held(fields.rows(), fields.cols());
    for (Eigen::Index k = 0; k < held.cols(); ++k)
      held.col(k) = held_part(model.dofs, fields.col(k));
    Eigen::CompleteOrthogonalDecomposition<Matrix> solver;
    solver.setThreshold(tells_less);
    along += fields * solver.compute(held).solve(held_part(model.dofs, here->rest - shape));
  }
  return here->rest + here->dofs.expand(here->dofs.pick(along - here->rest));
}

}  // namespace genio
