#include "forward/effects/effect.hpp"

#include <stdexcept>

namespace genio {

std::vector<const Term*> Effect::terms() const {
  std::vector<const Term*> result;
  for (const Term* term :
       {static_cast<const Term*>(potential.get()), static_cast<const Term*>(dissipation.get()),
        static_cast<const Term*>(inertia.get()), static_cast<const Term*>(filter.get()),
        modes.get()})
    if (term) result.push_back(term);
  return result;
}

std::string_view Effect::name() const {
  const auto all = terms();
  if (all.empty()) throw std::logic_error("an effect without any term has no name");
  return all.front()->name();
}

std::vector<ParameterInfo> Effect::parameters() const {
  std::vector<ParameterInfo> result;
  for (const Term* term : terms()) {
    const auto own = term->parameters();
    result.insert(result.end(), own.begin(), own.end());
  }
  return result;
}

}  // namespace genio
