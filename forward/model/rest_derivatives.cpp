#include "forward/model/rest_derivatives.hpp"

#include "forward/effects/modes/moved_rest.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/build_effects.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/sums.hpp"

namespace genio {
namespace {

constexpr double step = 1e-2;  // [sd]

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

}  // namespace

Matrix force_by_modes(const Model& model, const Positions& x, const Parameters& p,
                      std::span<const int> modes) {
  Matrix result = Matrix::Zero(x.size(), Eigen::Index(modes.size()));
  if (modes.empty()) return result;
  const std::vector<double> at = values_of_modes(model, p);
  const Remade remade(model, p);
  const auto here = at_anatomy(model, p);
  std::vector<const AnatomyMode*> all;
  for (const int k : modes) all.push_back(&model.description->modes[size_t(k)]);
  for (const auto& contact : here->contacts)
    contact->add_force_along(x, contact.values(p), here->rest, all, result);
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

}  // namespace genio
