#include "forward/effects/belief.hpp"

namespace genio {

std::vector<ParameterBelief> beliefs_of(const Belief& belief,
                                        std::span<const ParameterInfo> parameters) {
  std::vector<ParameterBelief> result;
  for (const ParameterInfo& info : parameters) {
    ParameterBelief found;
    for (const ParameterBelief& b : belief.parameters)
      if (b.parameter.empty() || b.parameter == info.name) found = b;
    found.parameter = info.name;
    result.push_back(std::move(found));
  }
  return result;
}

std::vector<Variant> variants_of(const Belief& belief, std::span<const ParameterInfo> parameters) {
  if (belief.variants) return belief.variants(parameters);
  std::vector<Variant> result;
  const auto believed = beliefs_of(belief, parameters);
  for (size_t k = 0; k < believed.size(); ++k)
    if (believed[k].typical > 0 && !believed[k].detail) result.push_back({.numbers = {{int(k)}}});
  return result;
}

}  // namespace genio
