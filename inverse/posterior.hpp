#pragma once
// What the data say about the forces beyond the best fit.

#include "inverse/box_gaussian.hpp"
#include "inverse/objective.hpp"

namespace genio {

/// The posterior about an optimum: Gaussian by the Hessian there (by Gauss-Newton's where the exact
/// one is indefinite), within the bounds. Unknowns that are fixed are left out; `which` names the
/// rest.
struct LocalPosterior {
  BoxGaussian density;
  std::vector<Eigen::Index> which;
};
LocalPosterior local_posterior(const Objective& objective, const ObjectivePoint& optimum);

/// Standard deviation and 90 % interval of samples: central, or, where the mode sits at a bound or
/// so near that the central interval would miss it, one-sided from that bound.
struct MarginalSummary {
  double sd, low, high;
};
MarginalSummary summarise(Vector samples, double mode, double lower, double upper);

/// Probability that a chi-square variable with `dof` degrees of freedom exceeds `chi2` (Wilson &
/// Hilferty 1931, accurate to 1e-3 for dof >= 3).
double chi_square_tail(double chi2, double dof);

/// Directions about which the data say less than the prior: eigenvalues below 1 of the data's
/// information in units of the prior's precision. Each is a group of commands and how much of each
/// trades for how much of the others, in their own units, the largest 1 in activation.
std::vector<TradeOff> unseen_directions(const Matrix& jacobian, const Matrix& prior_precision,
                                        const std::vector<Command>& commands);

/// Fills estimates, unidentified groups, chi2, verdict and evidence of `answer` from the optimum's
/// derivatives.
///
/// Verdict by the chi-square test at the 1 % level of sum (distance / sigma)^2 with rows minus
/// effective parameters as degrees of freedom: passed is `explained`. Otherwise `unreachable` when
/// the Gauss-Newton step of the problem without bounds would take away at least half of the excess
/// (the bounds stop it), else `mismatch`.
void summarise_posterior(const Objective& objective, const ObjectivePoint& optimum,
                         const Comparison& comparison, Answer& answer);

}  // namespace genio
