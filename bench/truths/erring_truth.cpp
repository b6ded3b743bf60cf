#include "bench/truths/erring_truth.hpp"

#include <functional>
#include <random>

namespace genio::bench {
namespace {

constexpr double fibre_turn = 5;  // [degrees]
constexpr double fung = 1.5;      // its second coefficient over that of the model's law

/// Without the fibres that refining puts between the model's.
ModelDescription single_lines(const ModelDescription& model) {
  ModelDescription d = refined(model);
  for (size_t m = 0; m < d.muscles.size(); ++m)
    d.muscles[m].fibres.resize(model.muscles[m].fibres.size());
  return d;
}

/// Fibres that stand four to six times: their shares lie 20 % about the mean of five.
ModelDescription other_shares(const ModelDescription& model, unsigned seed) {
  ModelDescription d = refined(model);
  for (Muscle& muscle : d.muscles) {
    // Left and right draw alike.
    std::mt19937 random(seed + unsigned(std::hash<std::string>()(bilateral_name(muscle.name))));
    std::uniform_int_distribution<int> times(4, 6);
    std::vector<Fibre> fibres;
    for (const Fibre& fibre : muscle.fibres)
      fibres.insert(fibres.end(), size_t(times(random)), fibre);
    muscle.fibres = std::move(fibres);
  }
  return d;
}

/// W = a10/b (exp(b (I - 3)) - 1) to its third term, of the same a10.
ModelDescription other_law(const ModelDescription& model) {
  ModelDescription d = refined(model);
  const EffectTable& tissue = d.effects.at("elasticity");
  const double a10 = tissue.at("a10"), a20 = tissue.at("a20");
  const double b = 2 * fung * a20 / a10;
  d.effects["material_nonlinearity"] = {{"a20", (fung - 1) * a20}, {"a30", a10 * b * b / 6}};
  return d;
}

}  // namespace

const char* to_string(ModelFault fault) {
  switch (fault) {
    case ModelFault::turned_fibres:
      return "turned_fibres";
    case ModelFault::single_lines:
      return "single_lines";
    case ModelFault::other_shares:
      return "other_shares";
    case ModelFault::other_law:
      return "other_law";
  }
  return "";
}

ModelDescription erring_truth(const ModelDescription& model, ModelFault fault, unsigned seed) {
  switch (fault) {
    case ModelFault::turned_fibres:
      return refined(with_turned_fibres(model, fibre_turn, seed));
    case ModelFault::single_lines:
      return single_lines(model);
    case ModelFault::other_shares:
      return other_shares(model, seed);
    case ModelFault::other_law:
      return other_law(model);
  }
  return model;
}

}  // namespace genio::bench
