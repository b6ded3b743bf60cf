#pragma once
// What a request's points are, before it is asked where they lie.

#include "inverse/recording/base/contours.hpp"
#include "server/wire/wire.hpp"

namespace genio {

/// The points in their own frame [m]. Throws InputError naming the point.
ContourFrame points_of(const shape_request_t& request);

/// The palate's trace in the frame of the points [m]; no points where there is none.
ContourFrame palate_of(const shape_request_t& request);

/// What points have that bring no noise of their own [m].
double noise_of(const shape_request_t& request);

}  // namespace genio
