#pragma once
// All that the project knows of an effect by name: how it is made, what is believed of it, and how
// it is tested.

#include <string>
#include <vector>

#include "forward/base/settings.hpp"
#include "forward/effects/anatomy.hpp"
#include "forward/effects/belief.hpp"
#include "forward/effects/effect.hpp"
#include "forward/effects/effect_change.hpp"

namespace genio {

/// A place where an effect may be, and the table that puts it there.
struct Place {
  std::string name = {};
  EffectTable table = {};
};

/// One row of the list of kinds (model/effect_kinds.cpp). Each effect's file ends with its own.
struct EffectKind {
  std::string name;  ///< of its table in a model file, [effect.NAME]
  /// Makes it from its table. Throws InputError naming what is wrong.
  Effect (*make)(Settings&, const Anatomy&);
  /// The parameter that the effect's name alone means, of an effect with a number of its own per
  /// condition ("jaw_opening" is its angle); empty: the parameter must be named.
  std::string main = {};
  /// True where every model has it, after all others and without a table.
  bool always = false;
  /// True where it acts from outside the tongue, so that its forces need not balance.
  bool external = false;
  /// How nodes are held where the effect is present; null: as without it. Such an effect holds
  /// nodes whatever its parameters.
  Support (*support)(Support) = nullptr;

  Belief belief = {};
  /// Where it may be, where that needs saying.
  std::vector<Place> (*places)(const ModelDescription&) = nullptr;

  /// Parameters at which it does something in the small block of the tests.
  EffectTable sample = {};
  /// Hides it in a tongue; null: the benchmark never does.
  EffectChange (*hidden)(const ChangeDraw&) = nullptr;
};

}  // namespace genio
