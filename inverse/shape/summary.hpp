#pragma once
// An answer from the optimum of an objective.

#include "inverse/posterior/posterior.hpp"
#include "inverse/shape/acting_posterior.hpp"
#include "inverse/shape/objective.hpp"

namespace genio {

/// The posterior about an optimum of the objective.
LocalPosterior local_posterior(const Objective& objective, const ObjectivePoint& optimum);

/// Fills estimates and joint statements of `answer` from the posterior's samples, at the best fit
/// z; keeps what its estimates say of bounds.
void set_estimates(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                   const ActingPosterior& posterior, const Vector& z, Answer& answer);

/// Fills `answer` with a point that is no optimum yet: forces without intervals.
void set_best_so_far(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                     const ObjectivePoint& point, Answer& answer);

/// Fills estimates, unidentified groups, chi2, verdict and evidence of `answer` from the optimum's
/// derivatives.
///
/// Verdict by the chi-square test at the 1 % level of r.(I + C)^-1 r, r the residuals and C what a
/// fit leaves of the model's own error, with rows minus effective parameters as degrees of freedom:
/// passed is `explained`. Otherwise `unreachable` when the Gauss-Newton step of the problem without
/// bounds would take away at least half of the excess (the bounds stop it), else `mismatch`.
///
/// The posterior is that of settled_posterior().
void summarise_posterior(Objective& objective, const ObjectivePoint& optimum,
                         const Comparison& comparison, const ModelError& error, Answer& answer);

}  // namespace genio
