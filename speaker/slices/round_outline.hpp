#pragma once
#include "speaker/slices/flat_stack.hpp"

namespace genio {

/// A closed outline with points in between, at most `step` apart [m] where it is curved: a cubic
/// through the points with the slopes of parabolas over the chords. A corner of more than 60
/// degrees stays a corner, so boxes stay boxes and a circle needs 7 points to be one.
FlatOutline round_outline(const FlatOutline& outline, double step);

}  // namespace genio
