#pragma once
#include <string>

#include "forward/effects/description.hpp"

namespace genio {

/// Constants of the effect elasticity, with a bulk modulus of 1000 a10: "cadaver" as measured on a
/// fresh cadaver (Gerard et al. 2005), "living" as scaled to relaxed muscle (Buchaillard et al.
/// 2009) [Pa]. Throws InputError for another name.
EffectTable named_tissue(const std::string& name);

}  // namespace genio
