#pragma once
// Where the tongue's line may lie: the rest line and the ways in which muscles move it.

#include <functional>

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// The line at rest and its few strongest ways to move.
struct TongueReach {
  std::vector<Vec2> rest;                ///< [m]
  std::vector<std::vector<Vec2>> modes;  ///< displacements of one standard deviation each [m]
  double scale_sd = 0.06;                ///< of the speaker's size, see ModelDescription
  /// Called before each step of a search along it, unless empty. What it throws ends the search.
  std::function<void()> on_step = {};
};

/// The principal modes of the equilibria in which one muscle each pulls with a fifth of its
/// maximum, scaled so that postures lie 5 mm (root mean square) from rest. Takes a static solve a
/// muscle, before each of which `on_step` is called unless empty; what that throws ends the work.
TongueReach reach_of(const Model& model, const std::function<void()>& on_step = {});

/// The foot of q on a line: its segment and the way along it from 0 to 1.
struct LineFoot {
  size_t segment;
  double part;
  Vec2 offset;  ///< from the foot to q
};
LineFoot foot_on(const std::vector<Vec2>& line, const Vec2& q);

}  // namespace genio
