#pragma once
// A Gaussian within bounds: what a posterior looks like where forces cannot be negative.

#include "forward/base/types.hpp"

namespace genio {

/// An unknown this near a bound sits at it.
constexpr double at_bound = 2e-4;

/// Density proportional to exp(-slope.d - d.H d / 2), d = z - mode, on lower <= z <= upper, H
/// positive definite.
struct BoxGaussian {
  Vector mode, slope;
  Matrix hessian;
  Vector lower, upper;
};

/// The same Gaussian by its centre, which may lie outside the bounds; the mode is the nearest point
/// within them.
BoxGaussian about(const Vector& centre, const Matrix& hessian, const Vector& lower,
                  const Vector& upper);

/// The same density by its highest point within the bounds, where that of about() need not be.
BoxGaussian at_mode(BoxGaussian density);

/// -1 where the density presses unknown i against its lower bound, 1 against the upper, else 0.
int pressed(const BoxGaussian& density, Eigen::Index i);

/// Draws `count` samples, a column each, by exact Hamiltonian Monte Carlo (Pakman & Paninski 2014,
/// J. Comput. Graph. Stat. 23): trajectories of the whitened Gaussian are circles that bounce off
/// the bounds. Always the same samples for the same arguments; the first `warming` are left out.
/// The density is given about its mode.
/// Throws std::invalid_argument where H is not positive definite.
Matrix sample(const BoxGaussian& density, int count, int warming = 100, unsigned seed = 20140601);

}  // namespace genio
