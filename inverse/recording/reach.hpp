#pragma once
// Where the tongue's line may lie: the rest line and the ways in which muscles move it.

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// The line at rest and its few strongest ways to move, by the derivative of the equilibrium in the
/// muscles' forces there (sensitivity()).
struct TongueReach {
  std::vector<Vec2> rest;                ///< [m]
  std::vector<std::vector<Vec2>> modes;  ///< displacements of one standard deviation each [m]
};

/// Muscles at a fifth of their maxima are one standard deviation; the modes are the principal ones
/// of all muscles together. Takes one static solve.
TongueReach reach_of(const Model& model);

/// A line of the reach near some points, and how far its modes are from rest, in squares of their
/// standard deviations.
struct ReachLine {
  std::vector<Vec2> points;
  double strain = 0;
};

/// The line that lies nearest to the points, at noise `sd` [m] against the modes' own spread.
ReachLine line_near(const TongueReach& reach, const std::vector<Vec2>& points, double sd);

/// The foot of q on a line: its segment and the way along it from 0 to 1.
struct LineFoot {
  size_t segment;
  double part;
  Vec2 offset;  ///< from the foot to q
};
LineFoot foot_on(const std::vector<Vec2>& line, const Vec2& q);

}  // namespace genio
