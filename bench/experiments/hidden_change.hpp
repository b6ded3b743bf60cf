#pragma once
// What is hidden in a data set, at any strength.

#include <functional>
#include <random>

#include "forward/effects/effect_change.hpp"
#include "forward/model/model.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio::bench {

/// A change of the tongue that grows with a number s >= 0, also one that no library has.
struct HiddenChange : EffectChange {
  bool in_library = true;  ///< "lump" and "tether" are in none
  /// What is added to the model of the truth by hand; may be empty.
  std::function<Model(const Model&, double)> by_hand = {};
  /// How the data are laid wrongly.
  std::function<HeadPose(double)> pose = {};
};

/// The changes that can be hidden: those of the effects' kinds, a head pose, and "lump" and
/// "tether", which are in no library.
const std::vector<std::string>& hidden_names();

/// Names the change in the seeds of its cases. Those that were measured first have numbers of
/// their own; a later one has a number above 100 from its name, so that it moves no other's seeds.
unsigned hidden_number(const std::string& name);

/// One at a random place. Throws std::invalid_argument for a name that is not among them.
HiddenChange hidden_change(const std::string& name, const ChangeDraw& draw);

}  // namespace genio::bench
