#pragma once
// Which muscles act, and how much: a posterior where each may also rest (spike and slab; Mitchell &
// Beauchamp 1988, J. Am. Stat. Assoc. 83).

#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// A density proportional to exp(pull.z - z.H z / 2) on lower <= z <= upper. H need not be definite
/// in what may rest: its slab adds to it.
struct QuadraticDensity {
  Matrix hessian;
  Vector pull;
  Vector lower, upper;
};

/// What is believed of unknowns that may rest at 0. One rests or acts; an acting one is half-normal
/// about 0. How large a part of all acts, and which of the widths holds for all of them, is not
/// known before: every number of acting ones is as likely as any other, and so is every width.
struct RestBelief {
  Vector slab;  ///< scale of an unknown's half-normal; 0: never rests, and H says all of it
  /// The other side of the same muscle; -1: none. Both count as one, and act alike.
  std::vector<Eigen::Index> partner;
  std::vector<double> widths = {0.5, 2.5};  ///< of the half-normals, in units of the scale
  double both = 0.8;                        ///< probability that the other side acts, too
  double alike = 0.9;                       ///< correlation of the two sides' forces
};

/// One choice of what acts.
struct ActingState {
  std::vector<bool> acts;  ///< an unknown each; true for what never rests
  size_t width;            ///< index into RestBelief::widths
  double weight;           ///< probability
};

/// The likeliest choices, likeliest first, with a sum of 1. All choices are weighed where they are
/// few, else those that a Markov chain visits. Each one's weight is an integral over the forces,
/// see log_integral(). Always the same for the same arguments. Throws std::runtime_error where no
/// choice has a weight, as of numbers beyond those of a computer.
std::vector<ActingState> acting_states(const QuadraticDensity& density, const RestBelief& belief);

/// Standard deviation of unknown i before the shape is seen.
double prior_sd(const RestBelief& belief, Eigen::Index i);

/// Samples, a column each, and their weights, of sum 1.
struct WeightedSamples {
  Matrix values;
  Vector weights;
};

/// About `count` samples of all states: of the likeliest, and of some of the others by their
/// weights. Unlikely states get a few as well, so that what is said of a muscle that hardly acts is
/// more than noise. What rests is exactly 0.
WeightedSamples sample(const QuadraticDensity& density, const RestBelief& belief,
                       const std::vector<ActingState>& states, int count);

}  // namespace genio
