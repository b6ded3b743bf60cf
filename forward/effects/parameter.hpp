#pragma once
// What an effect lets you vary.

#include <span>
#include <string>

namespace genio {

/// A parameter of an effect: where it stands, how far it may go, and where the effect vanishes.
struct ParameterInfo {
  std::string name = {};  ///< "GGP_L", "a10", "z"
  std::string unit = {};  ///< "N", "Pa", "m/s^2"
  double value = 0;       ///< value in the model as read
  double lower = 0;       ///< bounds
  double upper = 0;
  double absent = 0;     ///< value at which what it stands for vanishes
  bool load = false;     ///< drives the shape away from rest; continuation brings it up from absent
  bool penalty = false;  ///< enforces a constraint; a far solve starts with a softer one
};

/// Values of the parameters that a term reads: its own in the order of Term::parameters(), then
/// those it borrows.
using EffectParameters = std::span<const double>;

}  // namespace genio
