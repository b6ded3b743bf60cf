#pragma once
#include "forward/base/types.hpp"
#include "forward/effects/term.hpp"

namespace genio {

/// Mass that is not the tissue's. It acts in dynamics only.
class Inertia : public Term {
 public:
  /// Adds to the mass of each node [kg].
  virtual void add_mass(EffectParameters p, Vector& mass) const = 0;
};

}  // namespace genio
