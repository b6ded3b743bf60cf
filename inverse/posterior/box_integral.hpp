#pragma once
// The mass of a Gaussian within bounds.

#include "inverse/posterior/box_gaussian.hpp"

namespace genio {

/// A density integrated between its bounds, H positive definite, with a point mass at each lower
/// bound beside the even measure between the bounds.
struct BoxIntegral {
  double log = 0;
  /// Of each unknown, all others integrated over: the normal that its own bounds cut.
  Vector centre, sd;
};

/// `spikes`: the point masses, 0 for none [length of the unknown].
BoxIntegral integral(const BoxGaussian& density, const Vector& spikes);

/// Its logarithm without point masses.
double log_integral(const BoxGaussian& density);

/// A normal cut at lower < upper: its mode, standard deviation and shortest interval that holds
/// nine in ten.
struct CutNormal {
  double mode, sd, low, high;
};
CutNormal cut_normal(double centre, double sd, double lower, double upper);

}  // namespace genio
