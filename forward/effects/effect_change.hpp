#pragma once
// An effect hidden in a tongue at any strength, to see whether a search finds it.

#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "forward/effects/description.hpp"

namespace genio {

/// A change of the tongue that grows with a number s >= 0.
struct EffectChange {
  std::string effect = {};  ///< as an answer should name it
  std::string where = {};
  bool symmetric = true;        ///< of both sides alike
  bool drawn = false;           ///< at a random place: another draw is another change
  double first = 1, most = 10;  ///< s to try first, and the largest that makes sense
  /// The tongue as it is, and as the model file has it.
  std::function<ModelDescription(ModelDescription, double)> truth = {}, shipped = {};
  /// The effect's parameters, as an answer should have them.
  std::function<EffectTable(double)> parameters = {};
};

/// What a change is drawn from.
struct ChangeDraw {
  const ModelDescription& tongue;
  /// The muscles of the data set's postures, most used first, by their bilateral names.
  const std::vector<std::string>& active;
  /// Where forces are not known, both sides are commanded alike.
  bool forces_known;
  std::mt19937& random;
};

/// Adds `table(s)` as [effect.NAME] to the tongue as it is.
EffectChange change_by_table(const std::string& name,
                             const std::function<EffectTable(double)>& table, double first,
                             double most);

/// Sets one parameter to absent + s unit.
struct ChangeOfNumber {
  std::string key;
  double absent, unit;
  double first, most;  ///< as in EffectChange
};
EffectChange change_by_number(const std::string& name, const ChangeOfNumber& number);

}  // namespace genio
