#pragma once
// What a shape says of the muscles: which act, and how much.

#include "inverse/posterior/acting.hpp"
#include "inverse/posterior/estimate.hpp"
#include "inverse/shape/objective.hpp"

namespace genio {

/// The posterior of the unknowns that are not fixed.
struct ActingPosterior {
  std::vector<Eigen::Index> which;
  RestBelief belief;
  Vector centre;            ///< its mean, as far as the model is right
  WeightedSamples samples;  ///< with the model's error
};

/// Covariance of the residuals, noise and the model's error together, in units of the noise.
Matrix residual_covariance(const Residuals& residuals, const ModelError& error, double way);

/// By the derivative of the shape at a point, with all terms of the prior, effort apart: what may
/// rest has a point and a slab in its place, see acting.hpp. The model errs by two fields over the
/// surface, which weigh the residuals, and by a factor of each muscle's force, which spreads the
/// samples: rest stays rest under it. `way`: of the line from rest, root mean square [m].
ActingPosterior acting_posterior(const ObjectivePoint& point, const std::vector<Unknown>& unknowns,
                                 const PriorTerms& prior, const ModelError& error, double way);

/// The same of a density over the unknowns that `prior` leaves open, effort among its terms, where
/// it is not a single shape's. `way` as above: it spreads the forces.
ActingPosterior acting_posterior(QuadraticDensity density, const std::vector<Unknown>& unknowns,
                                 const PriorTerms& prior, const ModelError& error, double way);

/// A derivative that foretells residuals to this many standard deviations a row changes no
/// posterior; one that does not is taken again elsewhere.
constexpr double straight = 0.1;

/// How far the residuals at `there` are from what the derivative at `here` foretells, in standard
/// deviations a row (root mean square).
double nonlinearity(const ObjectivePoint& here, const ObjectivePoint& there);
/// The same after a step from where residuals and their derivative are known.
double nonlinearity(const Vector& residuals, const Matrix& jacobian, const Vector& step,
                    const Vector& there);

/// Pairs of muscles of which at least one surely acts, though neither does surely, likeliest first.
std::vector<JointForce> joint_forces(const ActingPosterior& posterior,
                                     const std::vector<Unknown>& unknowns);

}  // namespace genio
