#pragma once
// Tails and quantiles of the distributions that tests of a fit use.

namespace genio {

/// Probability that a chi-square variable with `dof` > 0 degrees of freedom, which need not be
/// whole, exceeds `chi2` >= 0. NaN for other arguments.
double chi_square_tail(double chi2, double dof);

/// Probability that a standard normal variable exceeds z.
double normal_tail(double z);

/// The z with normal_tail(z) = tail, 0 < tail < 1.
double normal_quantile(double tail);

}  // namespace genio
