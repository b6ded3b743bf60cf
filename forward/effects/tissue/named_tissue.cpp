#include "forward/effects/tissue/named_tissue.hpp"

#include <fmt/format.h>

namespace genio {

EffectTable named_tissue(const std::string& name) {
  if (name == "cadaver") return {{"a10", 192}, {"a20", 90}, {"kappa", 192000}};
  if (name == "living") return {{"a10", 1037}, {"a20", 486}, {"kappa", 1037000}};
  throw InputError(fmt::format("tissue {}: expected cadaver or living", name));
}

}  // namespace genio
