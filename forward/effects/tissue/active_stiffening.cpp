#include "forward/effects/tissue/active_stiffening.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "forward/tissue/segment_forces.hpp"

namespace genio {
namespace {

constexpr int first_command = 3;  // after factor, a10 and a20

/// a10 and a20 of the elasticity, scaled element by element.
template <class Scale>
BatchTissue scaled(const ElementBatch& batch, double a10, double a20, Scale scale) {
  lanes::Lane s;
  for (int l = 0; l < lanes::width; ++l) s[l] = scale(batch.element[l]);
  BatchTissue t;
  t.law.fill({a10 * s, a20 * s, lanes::splat(0)});
  t.kappa = lanes::splat(0);
  return t;
}

}  // namespace

ActiveStiffening::ActiveStiffening(const HexMesh& mesh, std::vector<Muscle> muscles, double factor,
                                   Recruitment recruitment)
    : TissuePotential(mesh),
      muscles_(std::move(muscles)),
      through_(mesh.elements.size()),
      recruitment_(recruitment),
      info_{{{.name = "factor",
              .unit = "1",
              .value = factor,
              .lower = 1,
              .upper = 100,
              .absent = 1}}} {
  for (size_t k = 0; k < muscles_.size(); ++k)
    for (int e : muscles_[k].elements) through_[size_t(e)].push_back(int(k));
}

std::vector<ParameterName> ActiveStiffening::borrows() const {
  std::vector<ParameterName> names = command_names(muscles_);
  names.insert(names.begin(), {{"elasticity", "a10"}, {"elasticity", "a20"}});
  return names;
}

double ActiveStiffening::activation(int element, EffectParameters p) const {
  double sum = 0, largest = 0;
  for (int k : through_[size_t(element)]) {
    const double a = p[size_t(first_command + k)] / muscles_[size_t(k)].max_force;
    sum += a, largest = std::max(largest, a);
  }
  return recruitment_ == Recruitment::sum ? std::min(sum, 1.0) : largest;
}

double ActiveStiffening::activation_derivative(int element, EffectParameters p, int muscle) const {
  const auto& here = through_[size_t(element)];
  if (std::find(here.begin(), here.end(), muscle) == here.end()) return 0;
  const double reached = activation(element, p), maximum = muscles_[size_t(muscle)].max_force;
  const bool counts = recruitment_ == Recruitment::sum
                          ? reached < 1
                          : p[size_t(first_command + muscle)] / maximum == reached;
  return counts ? 1 / maximum : 0;
}

BatchTissue ActiveStiffening::tissue(size_t b, EffectParameters p) const {
  return scaled(batches_[b], p[1], p[2], [&](int e) { return (p[0] - 1) * activation(e, p); });
}

BatchTissue ActiveStiffening::tissue_derivative(size_t b, EffectParameters p, int k) const {
  if (k == 0) return scaled(batches_[b], p[1], p[2], [&](int e) { return activation(e, p); });
  if (k < first_command)
    return scaled(batches_[b], k == 1, k == 2,
                  [&](int e) { return (p[0] - 1) * activation(e, p); });
  return scaled(batches_[b], p[1], p[2],
                [&](int e) { return (p[0] - 1) * activation_derivative(e, p, k - first_command); });
}

EffectKind active_stiffening_kind() {
  return {.name = "active_stiffening",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const double factor = s.take("factor", 10), largest = s.take("largest", 0);
            if (largest != 0 && largest != 1)
              throw InputError(
                  fmt::format("{}: [effect.active_stiffening] largest = {}; expected 0 (muscles "
                              "of an element add up) or 1 (the largest counts)",
                              a.source, largest));
            return {.potential = std::make_shared<ActiveStiffening>(
                        a.description.mesh, a.muscles, factor,
                        largest == 1 ? Recruitment::largest : Recruitment::sum)};
          },
          .belief = {.parameters = {{.parameter = "factor", .typical = 9}}},
          .sample = {{"factor", 6}},
          .hidden =
              [](const ChangeDraw&) {
                return change_by_number(
                    "active_stiffening",
                    {.key = "factor", .absent = 1, .unit = 1, .first = 9, .most = 90});
              }};
}

}  // namespace genio
