#pragma once
// What a movement says of the muscles at each knot. Not for other rooms.

#include "inverse/sequence/motion_problem.hpp"
#include "inverse/shape/acting_posterior.hpp"

namespace genio {

/// The prior of one knot's unknowns, with the bounds that hold there.
PriorTerms terms_at(const MotionProblem& problem, size_t knot);

/// acting_posterior() of each knot's unknowns. The other knots are marginalised as Gaussians, those
/// unknowns of theirs that a bound holds with no spread; the walk from knot to knot is in it. The
/// derivative is that at the optimum u or, where it does not foretell the frames at the posterior's
/// mean, the one there. The problem's latest point is another one afterwards.
std::vector<ActingPosterior> motion_posterior(MotionProblem& problem, const Vector& u,
                                              const ModelError& error);

}  // namespace genio
