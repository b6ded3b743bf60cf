#pragma once
// The posterior by a derivative that holds where the posterior lies.

#include "inverse/shape/acting_posterior.hpp"

namespace genio {

/// How far the shape's midsagittal line lies from rest, root mean square [m]: what the model's
/// error is a part of.
double displacement_from_rest(const Comparison& comparison, const Positions& x);

struct SettledPosterior {
  ObjectivePoint point;  ///< where the derivative was taken
  ActingPosterior posterior;
};

/// acting_posterior() by the derivative at the optimum, or, where that does not foretell the shape
/// at the posterior's mean, by the derivative there.
SettledPosterior settled_posterior(Objective& objective, const ObjectivePoint& optimum,
                                   const Comparison& comparison, const ModelError& error);

}  // namespace genio
