#include "forward/model/sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/model/at_anatomy.hpp"
#include "forward/model/rest_derivatives.hpp"

namespace genio {
namespace {

/// add(term, its values, its parameter, column), for every term of a list that reads one of
/// `parameters`, added to the columns of `result`.
template <class T, class Add>
void add_derivatives(const std::vector<Placed<T>>& terms, const Parameters& p,
                     std::span<const int> parameters, Add add, Matrix& result) {
  Forces column;
  for (const Placed<T>& term : terms) {
    const auto values = term.values(p);
    for (size_t c = 0; c < parameters.size(); ++c)
      for (size_t k = 0; k < term.inputs.size(); ++k) {
        if (term.inputs[k] != parameters[c]) continue;
        column = Forces::Zero(result.rows());
        add(*term.term, values, int(k), column);
        result.col(Eigen::Index(c)) += column;
      }
  }
}

const Placed<JointForces>* joint_forces_of(const Model& model, int effect) {
  for (const auto& joint : model.joint_forces)
    if (joint.effect == effect) return &joint;
  return nullptr;
}

}  // namespace

double energy(const Model& model, const Positions& x, const Parameters& p) {
  std::shared_ptr<const Model> here;
  try {
    here = at_anatomy(model, p);
  } catch (const InputError&) {
    return std::numeric_limits<double>::infinity();  // an anatomy that nobody can have
  }
  double total = 0;
  for (const auto& e : here->potentials) {
    if (!std::isfinite(total)) break;
    total += e->energy(x, e.values(p));
  }
  return total;
}

Forces forces_of(const Model& model, const Positions& x, const Parameters& p,
                 const std::function<bool(const Effect&)>& which) {
  const auto here = at_anatomy(model, p);
  Forces f = Forces::Zero(x.size());
  for (const auto& e : here->potentials)
    if (which(model.effects[size_t(e.effect)])) e->add_force(x, e.values(p), f);
  return f;
}

Forces force(const Model& model, const Positions& x, const Parameters& p) {
  return forces_of(model, x, p, [](const Effect&) { return true; });
}

double load_size(const Model& model, const Positions& x, const Parameters& p) {
  const auto here = at_anatomy(model, p);
  constexpr double floor = 1e-3;  // [N]
  Forces f;
  double sum = 0;
  for (const auto& e : here->potentials) {
    const auto infos = e->parameters();
    if (std::none_of(infos.begin(), infos.end(),
                     [](const ParameterInfo& i) { return i.load || i.penalty; }))
      continue;
    f = Forces::Zero(x.size());
    e->add_force(x, e.values(p), f);
    sum += f.squaredNorm();
  }
  return std::max(std::sqrt(sum), floor);
}

void stiffness(const Model& model, const Positions& x, const Parameters& p, Stiffness& k) {
  const auto here = at_anatomy(model, p);
  k.set_zero();
  for (const auto& e : here->potentials) e->add_stiffness(x, e.values(p), k);
}

void step_stiffness(const Model& model, const Positions& x, const LinearStep& led,
                    const Parameters& p, Stiffness& k) {
  const auto here = at_anatomy(model, p);
  k.set_zero();
  for (const auto& e : here->potentials)
    if (const NewtonAid* aid = e->newton_aid()) aid->add_step_stiffness(x, led, e.values(p), k);
    else e->add_stiffness(x, e.values(p), k);
}

Bulk bulk(const Model& model, const Positions& x, const Parameters& p) {
  const auto here = at_anatomy(model, p);
  Vector kappa = Vector::Zero(Eigen::Index(here->mesh.elements.size()));
  for (const auto& e : here->potentials)
    if (const NewtonAid* aid = e->newton_aid()) aid->add_bulk_modulus(e.values(p), kappa);
  Bulk result{VolumeGradients(here->batches, x), {}, {}, Vector(kappa.size())};
  for (const ElementBatch& batch : *here->batches)
    for (int l = 0; l < batch.count; ++l) result.volume[batch.element[l]] = batch.volume[l];
  result.stiffness = kappa.cwiseQuotient(result.volume);
  // Volumes are homogeneous of third degree in the positions (Euler).
  result.excess = result.gradients.rates(x) / 3 - result.volume;
  return result;
}

double step_limit(const Model& model, const Positions& x, const Positions& along,
                  const Parameters& p) {
  const auto here = at_anatomy(model, p);
  double t = 1.0;
  for (const auto& e : here->potentials)
    if (const NewtonAid* aid = e->newton_aid())
      t = std::min(t, aid->step_limit(x, along, e.values(p)));
  return t;
}

Forces forces_in_motion(const Model& model, const Positions& x, const Vector& v,
                        const Parameters& p, Forces& viscous) {
  const auto here = at_anatomy(model, p);
  Forces f = Forces::Zero(x.size());
  viscous = f;
  for (const auto& e : here->potentials)
    if (const auto* joint = joint_forces_of(*here, e.effect))
      (*joint)->add_forces(x, v, joint->values(p), f, viscous);
    else e->add_force(x, e.values(p), f);
  for (const auto& d : here->dissipations)
    if (!joint_forces_of(*here, d.effect)) d->add_viscous_force(x, v, d.values(p), viscous);
  return f;
}

void add_damping(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                 double scale, Stiffness& scratch, Stiffness& k) {
  const auto here = at_anatomy(model, p);
  scratch.set_zero();
  for (const auto& d : here->dissipations) d->add_damping(x, v, d.values(p), scratch);
  k.add(scratch, scale);
}

NodeMatrix mass_matrix(const Model& model, const Parameters& p) {
  const auto here = at_anatomy(model, p);
  if (here->tissue_mass.size() == 0)
    throw InputError(model.name + ": the model has no mass; dynamics needs its density");
  Vector points = Vector::Zero(here->tissue_mass.rows());
  for (const auto& i : here->inertias) i->add_mass(i.values(p), points);
  NodeMatrix mass = here->tissue_mass;
  mass.diagonal() += points;
  return mass;
}

Matrix force_derivatives(const Model& model, const Positions& x, const Parameters& p,
                         std::span<const int> parameters) {
  const auto here = at_anatomy(model, p);
  Matrix result = Matrix::Zero(x.size(), Eigen::Index(parameters.size()));
  add_derivatives(
      here->potentials, p, parameters,
      [&](const Potential& e, EffectParameters values, int k, Forces& df) {
        e.add_force_derivative(x, values, k, df);
      },
      result);
  std::vector<int> modes;
  std::vector<Eigen::Index> columns;
  for (size_t c = 0; c < parameters.size(); ++c)
    if (const int mode = mode_of(model, parameters[c]); mode >= 0)
      modes.push_back(mode), columns.push_back(Eigen::Index(c));
  result(Eigen::all, columns) += force_by_modes(model, x, p, modes);
  return result;
}

Matrix motion_force_derivatives(const Model& model, const Positions& x, const Vector& v,
                                const Parameters& p, std::span<const int> parameters) {
  const auto here = at_anatomy(model, p);
  Matrix result = force_derivatives(model, x, p, parameters);
  add_derivatives(
      here->dissipations, p, parameters,
      [&](const Dissipation& d, EffectParameters values, int k, Forces& df) {
        d.add_viscous_force_derivative(x, v, values, k, df);
      },
      result);
  return result;
}

Matrix viscous_slope(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                     const Matrix& along, Stiffness& scratch) {
  const auto here = at_anatomy(model, p);
  Matrix df = Matrix::Zero(along.rows(), along.cols());
  for (const auto& d : here->dissipations)
    d->add_viscous_force_slope(x, v, d.values(p), along, scratch, df);
  return df;
}

double max_penetration(const Model& model, const Positions& x, const Parameters& p) {
  const auto here = at_anatomy(model, p);
  double depth = 0;
  for (const auto& contact : here->contacts)
    depth = std::max(depth, contact->max_penetration(x, contact.values(p)));
  return depth;
}

}  // namespace genio
