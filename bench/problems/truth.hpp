#pragma once
// Tongues that differ from the model that will judge them, to make targets without inverse crime.

#include "forward/anatomy/refined_model.hpp"

namespace genio::bench {

/// The same tongue with its inner nodes shifted by a smooth random field that turns fibre segments
/// by `degrees` on average; the surface and what is supported stay.
ModelDescription with_turned_fibres(ModelDescription description, double degrees, unsigned seed);

/// Mean angle between the fibre segments of two tongues of the same mesh [degrees].
double mean_turn(const ModelDescription& a, const ModelDescription& b);

}  // namespace genio::bench
