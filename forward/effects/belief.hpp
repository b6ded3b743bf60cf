#pragma once
// What a search for missing effects believes of an effect before it sees data.

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "forward/effects/parameter.hpp"

namespace genio {

/// What is believed of one parameter.
struct ParameterBelief {
  std::string parameter = {};  ///< its name; empty: every parameter of the effect
  /// How far from `absent` it tends to be where what it stands for is there. A parameter without is
  /// never asked for.
  double typical = 0;
  /// True where it says where or how large. It counts only where some strength of its effect is off
  /// its absent value; `typical` is then how uncertain it is.
  bool detail = false;
  /// Within the bounds, where it is ever found where what it stands for is there.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  /// True for a factor, 1 where absent: what is believed of it, `typical` too, is of its logarithm.
  bool ratio = false;
};

/// One way in which an effect may show: numbers let off their absent values at once.
struct Variant {
  std::string where = {};  ///< "GGP_L"; empty where the effect has but one
  /// Of each number, the parameters that take its value, by their index.
  std::vector<std::vector<int>> numbers;
};

/// What is believed of an effect; without parameters it is no candidate for what a model lacks.
struct Belief {
  std::vector<ParameterBelief> parameters = {};
  /// The ways in which it may show; null: each parameter that is believed in and no detail, by
  /// itself.
  std::vector<Variant> (*variants)(std::span<const ParameterInfo>) = nullptr;
  /// What is never met about such values of the effect's own parameters, alone or together, as an
  /// end to "it would ..."; empty or null: nothing. Nobody names an effect with them.
  std::string (*implausible)(EffectParameters) = nullptr;
};

/// Of each parameter, in their order.
std::vector<ParameterBelief> beliefs_of(const Belief& belief,
                                        std::span<const ParameterInfo> parameters);

/// The ways in which an effect with these parameters may show.
std::vector<Variant> variants_of(const Belief& belief, std::span<const ParameterInfo> parameters);

}  // namespace genio
