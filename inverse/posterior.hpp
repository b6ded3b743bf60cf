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

/// The same where the model errs by `covariance` (of the residuals), which the fit did not know:
/// the estimate scatters by H^-1 J^T C J H^-1 more (the sandwich of Huber 1967).
LocalPosterior widened(const LocalPosterior& posterior, const Matrix& jacobian,
                       const Matrix& covariance);

/// Standard deviation of samples and the shortest interval that holds 90 % of them and the mode: it
/// is one-sided where the density does not fall towards a bound, so that a muscle that may well be
/// at rest is not claimed to pull.
struct MarginalSummary {
  double sd, low, high;
};
MarginalSummary summarise(Vector samples, double mode, double lower, double upper);

/// Probability that a chi-square variable with `dof` degrees of freedom exceeds `chi2` (Wilson &
/// Hilferty 1931, accurate to 1e-3 for dof >= 3).
double chi_square_tail(double chi2, double dof);

/// How far the shape's midsagittal line lies from rest, root mean square [m]: what the model's
/// error is a part of.
double way_from_rest(const Comparison& comparison, const Positions& x);

/// The chi-square test of a fit, and what it means.
struct FitTest {
  double chi2_per_dof, tail;
  Verdict verdict;
};
/// `scatter`: covariance of the residuals; `used`: effective parameters; `gain`: what the objective
/// would lose, twice, by the Gauss-Newton step of the problem without bounds.
FitTest test_fit(const Vector& residuals, const Matrix& scatter, double used, double gain);

/// Estimate of an unknown from its mode and samples of its posterior and of its prior.
CommandEstimate estimate(const Command& command, double mode, double lower, double upper,
                         const Vector& samples, const Vector& believed);

/// Directions about which the data say less than the prior: eigenvalues below 1 of the data's
/// information in units of the prior's precision. Each is a group of commands and how much of each
/// trades for how much of the others, in their own units, the largest 1 in activation.
std::vector<TradeOff> unseen_directions(const Matrix& jacobian, const Matrix& prior_precision,
                                        const std::vector<Command>& commands);

/// Fills estimates, unidentified groups, chi2, verdict and evidence of `answer` from the optimum's
/// derivatives.
///
/// Verdict by the chi-square test at the 1 % level of r.(I + C)^-1 r, r the residuals and C what a
/// fit leaves of the model's own error, with rows minus effective parameters as degrees of freedom:
/// passed is `explained`. Otherwise `unreachable` when the Gauss-Newton step of the problem without
/// bounds would take away at least half of the excess (the bounds stop it), else `mismatch`.
void summarise_posterior(const Objective& objective, const ObjectivePoint& optimum,
                         const Comparison& comparison, const ModelError& error, Answer& answer);

}  // namespace genio
