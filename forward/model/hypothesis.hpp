#pragma once
// What a model may lack: every effect it has not, at vanishing strength.

#include <string>
#include <vector>

#include "forward/effects/belief.hpp"
#include "forward/effects/description.hpp"
#include "forward/effects/effect.hpp"

namespace genio {

/// A number that a hypothesis lets off its absent value, or that says where and how large.
struct FreeNumber {
  std::string name = {};               ///< "angle", "GGP"
  std::vector<std::string> keys = {};  ///< of the effect's table, all of which take its value
  ParameterInfo info = {};             ///< of the first; bounds: where it is believed to be
  ParameterBelief belief = {};         ///< of the first

  /// How far a value is from `absent`, in the terms of the typical one; and the value so far off.
  double off(double value) const;
  double at(double off) const;
};

/// "stiff_region (anterior)"; without a place the effect's name.
std::string label(const std::string& effect, const std::string& where);

/// One way in which one effect may be what a model lacks.
struct Hypothesis {
  std::string effect;                 ///< "stiff_region"
  std::string where;                  ///< "anterior", "STY_L"; empty where there is but one way
  EffectTable table;                  ///< puts it into a model file at vanishing strength
  std::vector<FreeNumber> strengths;  ///< let off their absent values
  std::vector<FreeNumber> details;    ///< matter once a strength is off its absent value
  Effect made;                        ///< from `table`

  std::string label() const { return genio::label(effect, where); }
  /// True where it is there or not: its strengths enforce a constraint and have no value to fit.
  bool is_switch() const;
  /// The model with it, at vanishing strength; `present`: a switch at its typical strength.
  ModelDescription added_to(ModelDescription description, bool present = false) const;
};

/// What is never met about such values of an effect's own parameters, as an end to "it would ...";
/// empty: nothing.
std::string implausible(const std::string& effect, EffectParameters values);

/// The model with those effects at vanishing strength that make unknowns of its supports, so that
/// they have a derivative: a jaw that could open, a hyoid that could move.
ModelDescription with_mobile_supports(ModelDescription description);

/// All that `description` may lack, in the order of effect_kinds(). An effect that the model has is
/// no hypothesis, unless it has parameters at their absent values and no place ("weak_muscle" of
/// other muscles). Effects that cannot be there (a contact without a surface) are left out.
std::vector<Hypothesis> hypotheses(const ModelDescription& description);

}  // namespace genio
