#pragma once
// What the data say about the forces beyond the best fit.

#include "inverse/objective.hpp"

namespace genio {

/// Marginal of one activation: proportional to exp(-slope (a - mode) - curvature (a - mode)^2 / 2)
/// on [0, 1].
struct Marginal {
  double mode, slope, curvature;
};

/// Moments of a Marginal and its central 90 % interval, or, where the mode sits at a bound or
/// so near that the central interval would miss it, the one-sided interval from there.
struct MarginalSummary {
  double sd, low, high;
};
MarginalSummary summarise(const Marginal& m, bool at_lower, bool at_upper);

/// Probability that a chi-square variable with `dof` degrees of freedom exceeds `chi2` (Wilson &
/// Hilferty 1931, accurate to 1e-3 for dof >= 3).
double chi_square_tail(double chi2, double dof);

/// Fills estimates, unidentified groups, chi2 and verdict of `answer` from the optimum's
/// derivatives. Laplace approximation with active bounds held: free commands have the covariance
/// of the free block of the Hessian; a command at a bound has the exponential tail that its
/// multiplier gives, with the free ones profiled out.
///
/// Verdict by the chi-square test at the 1 % level of sum (distance / sigma)^2 with rows minus
/// effective parameters as degrees of freedom: passed is `explained`. Otherwise `unreachable` when
/// the Gauss-Newton step of the problem without bounds would take away at least half of the excess
/// (the bounds stop it), else `mismatch`.
void summarise_posterior(const Objective& objective, const ObjectivePoint& optimum,
                         const Comparison& comparison, Answer& answer);

}  // namespace genio
