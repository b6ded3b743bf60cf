#pragma once
// How a file's own doubt of a point widens the noise that it is given.

#include "inverse/recording/base/contours.hpp"

namespace genio {

/// For a point that is right with probability `p` and else lies anywhere, where it tells nothing.
/// What it is expected to tell, 1 / sigma^2, is p times that of a sure one: 1 / sqrt(p).
double widening_by_likelihood(double p);

/// For a tracker's confidence, which is no probability: points of the `usual` one or above have the
/// usual noise, and the variance of others grows as theirs falls: sqrt(usual / confidence).
double widening_by_confidence(double confidence, double usual);

/// For the residual of an articulograph's field, in its own units. Good sensors have up to 15, and
/// the place that is solved for errs in proportion to what is left: residual / 15.
double widening_by_residual(double rms);

/// Remarks how many points count less than the others, and how much at most.
void remark_widened(ContourFile& file);

}  // namespace genio
