#include "forward/model/rest_derivatives.hpp"

#include <algorithm>

#include "forward/effects/modes/moved_rest.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/build_effects.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/sums.hpp"

namespace genio {
namespace {

constexpr double step = 1e-2;           // [sd]
constexpr double step_of_bones = 1e-3;  // [sd]: contact hardens over 0.055 mm

std::vector<double> values_of_modes(const Model& model, const Parameters& p) {
  if (!model.anatomy.empty()) return model.anatomy.front().values(p);
  return std::vector<double>(model.description->modes.size(), 0.0);
}

/// The model's potentials in other rest configurations, without its contacts.
class Remade {
 public:
  Remade(const Model& model, const Parameters& p) : model_(model), p_(p) {}

  Forces force(const std::vector<double>& modes, const Positions& x) const {
    const ModelDescription d = moved(*model_.description, modes);
    const Anatomy anatomy = anatomy_of(d, model_.name, model_.description.get());
    Forces f = Forces::Zero(x.size());
    for (const Placed<Potential>& e : model_.potentials) {
      if (model_.effects[size_t(e.effect)].contact) continue;
      const std::string name(e->name());
      const auto table = d.effects.find(name);
      make_effect(name, table == d.effects.end() ? EffectTable() : table->second, anatomy)
          .potential->add_force(x, e.values(p_), f);
    }
    return f;
  }

 private:
  const Model& model_;
  const Parameters& p_;
};

/// The modes themselves.
std::vector<const AnatomyMode*> chosen(const Model& model, std::span<const int> modes) {
  std::vector<const AnatomyMode*> result;
  for (const int k : modes) result.push_back(&model.description->modes[size_t(k)]);
  return result;
}

/// What contacts at the anatomy of p do as all goes along with these modes.
Matrix force_of_contacts(const Model& model, const Positions& x, const Parameters& p,
                         const std::vector<const AnatomyMode*>& modes) {
  Matrix result = Matrix::Zero(x.size(), Eigen::Index(modes.size()));
  const auto here = at_anatomy(model, p);
  for (const auto& contact : here->contacts)
    contact->add_force_along(x, contact.values(p), here->rest, modes, result);
  return result;
}

bool touches(const Model& model, const Positions& x, const Parameters& p) {
  const auto here = at_anatomy(model, p);
  return std::any_of(here->contacts.begin(), here->contacts.end(),
                     [&](const auto& c) { return c->energy(x, c.values(p)) > 0; });
}

}  // namespace

Matrix force_by_modes(const Model& model, const Positions& x, const Parameters& p,
                      std::span<const int> modes) {
  if (modes.empty()) return Matrix::Zero(x.size(), 0);
  const std::vector<double> at = values_of_modes(model, p);
  const Remade remade(model, p);
  const auto all = chosen(model, modes);
  Matrix result = force_of_contacts(model, x, p, all);
  Stiffness k(model.pattern);
  stiffness(model, x, p, k);
  for (size_t c = 0; c < modes.size(); ++c) {
    const Vector field = nodal_field(*all[c]);
    auto column = result.col(Eigen::Index(c));
    for (const auto& [steps, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      std::vector<double> beside = at;
      beside[size_t(modes[c])] += steps * step;
      column += weight / (12 * step) * remade.force(beside, x + steps * step * field);
    }
    column += k.multiply(followed(model.dofs, field));
  }
  return result;
}

Matrix force_by_mode_pairs(const Model& model, const Positions& x, const Parameters& p,
                           std::span<const int> modes, const Vector& adjoint) {
  const auto count = Eigen::Index(modes.size());
  const auto all = chosen(model, modes);
  const std::vector<double> at = values_of_modes(model, p);
  const Remade remade(model, p);
  const auto force_at = [&](Eigen::Index j, double by_j, Eigen::Index k, double by_k) {
    std::vector<double> beside = at;
    beside[size_t(modes[size_t(j)])] += by_j, beside[size_t(modes[size_t(k)])] += by_k;
    return adjoint.dot(remade.force(
        beside, x + by_j * nodal_field(*all[size_t(j)]) + by_k * nodal_field(*all[size_t(k)])));
  };
  Matrix result = Matrix::Zero(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index k = 0; k <= j; ++k)
      result(j, k) = result(k, j) = (force_at(j, step, k, step) - force_at(j, step, k, -step) -
                                     force_at(j, -step, k, step) + force_at(j, -step, k, -step)) /
                                    (4 * step * step);
  if (!touches(model, x, p)) return result;
  Matrix of_contacts(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto along = [&](double h) -> Vector {
      Parameters q = p;
      q[model.anatomy.front().inputs[size_t(modes[size_t(j)])]] += h;
      return force_of_contacts(model, x + h * nodal_field(*all[size_t(j)]), q, all).transpose() *
             adjoint;
    };
    of_contacts.col(j) = (along(step_of_bones) - along(-step_of_bones)) / (2 * step_of_bones);
  }
  return result + 0.5 * (of_contacts + of_contacts.transpose());
}

}  // namespace genio
