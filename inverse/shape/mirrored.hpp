#pragma once
// The same forces with left and right exchanged.

#include <optional>

#include "inverse/shape/acting_posterior.hpp"

namespace genio {

/// Where the two sides of a muscle pull unlike and the shape hardly tells which is which: the
/// probability that they are the other way round, from the cost of the mirrored forces against that
/// of the optimum. The samples are mixed with their mirror images by it. Empty where the sides are
/// not told apart, pull alike, or the shape tells them well.
std::optional<double> mix_mirrored(Objective& objective, const ObjectivePoint& optimum,
                                   ActingPosterior& posterior);

}  // namespace genio
