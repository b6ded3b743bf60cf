#pragma once
#include "forward/effects/kind.hpp"

namespace genio {

/// Contact and its damping, with the hard palate and with the inner jaw.
EffectKind palate_contact_kind();
EffectKind jaw_contact_kind();

}  // namespace genio
