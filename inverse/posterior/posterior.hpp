#pragma once
// What the data say about the forces beyond the best fit.

#include "inverse/posterior/box_gaussian.hpp"
#include "inverse/posterior/estimate.hpp"
#include "inverse/prior/prior.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// The posterior about an optimum: Gaussian by the Hessian there (by Gauss-Newton's where the exact
/// one is indefinite), within the bounds. Unknowns that are fixed are left out; `which` names the
/// rest.
struct LocalPosterior {
  BoxGaussian density;
  std::vector<Eigen::Index> which;
};
/// `exact`, `gauss_newton`: the Hessian at z over all unknowns.
LocalPosterior local_posterior(const PriorTerms& prior, const Vector& z, const Vector& gradient,
                               const Matrix& exact, const Matrix& gauss_newton);

/// The prior of the unknowns that are not fixed, given the fixed ones.
BoxGaussian density_of(const PriorTerms& prior);

/// Of weighted samples: moments, and the shortest interval that holds 90 % of them. It is one-sided
/// where the density does not fall towards a bound. Throws InputError where samples are not finite,
/// as numbers lost all their digits.
struct MarginalSummary {
  double mean, median, sd, low, high;
};
MarginalSummary summarise(const Vector& samples, const Vector& weights, double lower, double upper);
/// The same of samples that count alike.
MarginalSummary summarise(const Vector& samples, double lower, double upper);

/// Of a muscle that may rest: the interval is that of the samples that act, and reaches 0 unless
/// those that rest are fewer than one in twenty.
struct ActingSummary {
  double acts;  ///< probability
  MarginalSummary force;
};
ActingSummary summarise_acting(const Vector& samples, const Vector& weights, double upper);

/// Probability below which a test says that something is wrong.
inline constexpr double test_level = 0.01;

/// The chi-square test of a fit, and what it means.
struct FitTest {
  double chi2_per_dof, tail;
  Verdict verdict;
};
/// `scatter`: covariance of the residuals; `used`: effective parameters; `gain`: what the objective
/// would lose, twice, by the Gauss-Newton step of the problem without bounds.
FitTest test_fit(const Vector& residuals, const Matrix& scatter, double used, double gain);

/// Estimate of an unknown from its mode, what its posterior says, and the prior's sd of z.
Estimate estimate(const Unknown& unknown, double mode, const MarginalSummary& posterior,
                  double prior_sd);

/// Directions about which the data say less than the prior: eigenvalues below 1 of the data's
/// information in units of the prior's precision. Each is a group of commands and how much of each
/// trades for how much of the others, in their own units, the largest 1 in activation.
std::vector<TradeOff> unseen_directions(const Matrix& jacobian, const Matrix& prior_precision,
                                        const std::vector<Unknown>& unknowns);

}  // namespace genio
