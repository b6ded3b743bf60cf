#include "forward/model/effect_kinds.hpp"

#include "forward/effects/bones/hyoid_mobility.hpp"
#include "forward/effects/bones/jaw_opening.hpp"
#include "forward/effects/modes/anatomy_modes.hpp"
#include "forward/effects/muscles/activation_dynamics.hpp"
#include "forward/effects/muscles/extra_muscle.hpp"
#include "forward/effects/muscles/force_length.hpp"
#include "forward/effects/muscles/force_velocity.hpp"
#include "forward/effects/muscles/muscles.hpp"
#include "forward/effects/muscles/weak_muscle.hpp"
#include "forward/effects/surroundings/airway_pressure.hpp"
#include "forward/effects/surroundings/contact_kinds.hpp"
#include "forward/effects/surroundings/gravity.hpp"
#include "forward/effects/tissue/active_stiffening.hpp"
#include "forward/effects/tissue/compressibility.hpp"
#include "forward/effects/tissue/elasticity.hpp"
#include "forward/effects/tissue/fibre_anisotropy.hpp"
#include "forward/effects/tissue/material_nonlinearity.hpp"
#include "forward/effects/tissue/mucosa_layer.hpp"
#include "forward/effects/tissue/stiff_region.hpp"
#include "forward/effects/tissue/viscosity.hpp"

namespace genio {

const std::vector<EffectKind>& effect_kinds() {
  // A line each, so that two additions do not meet.
  // clang-format off
  static const std::vector<EffectKind> all = {
      elasticity_kind(),
      muscles_kind(),
      palate_contact_kind(),
      jaw_contact_kind(),
      gravity_kind(),
      active_stiffening_kind(),
      fibre_anisotropy_kind(),
      material_nonlinearity_kind(),
      compressibility_kind(),
      mucosa_layer_kind(),
      stiff_region_kind(),
      weak_muscle_kind(),
      extra_muscle_kind(),
      force_length_kind(),
      force_velocity_kind(),
      activation_dynamics_kind(),
      jaw_opening_kind(),
      hyoid_mobility_kind(),
      airway_pressure_kind(),
      viscosity_kind(),
      anatomy_kind(),
  };
  // clang-format on
  return all;
}

const EffectKind* find_kind(const std::string& name) {
  for (const EffectKind& kind : effect_kinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace genio
