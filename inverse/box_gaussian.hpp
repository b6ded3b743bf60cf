#pragma once
// A Gaussian within bounds: what a posterior looks like where forces cannot be negative.

#include "forward/types.hpp"

namespace genio {

/// Density proportional to exp(-slope.d - d.H d / 2), d = z - mode, on lower <= z <= upper, H
/// positive definite.
struct BoxGaussian {
  Vector mode, slope;
  Matrix hessian;
  Vector lower, upper;
};

/// Draws `count` samples, a column each, by exact Hamiltonian Monte Carlo (Pakman & Paninski 2014,
/// J. Comput. Graph. Stat. 23): trajectories of the whitened Gaussian are circles that bounce off
/// the bounds. Always the same samples for the same arguments. Throws std::invalid_argument where H
/// is not positive definite.
Matrix sample(const BoxGaussian& density, int count);

/// Logarithm of the integral of the density, by Laplace's method with the bounds that press on the
/// mode: an exponential across each of these, a Gaussian along the rest.
double log_integral(const BoxGaussian& density);

}  // namespace genio
