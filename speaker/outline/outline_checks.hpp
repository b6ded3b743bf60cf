#pragma once
#include "speaker/outline/outline.hpp"

namespace genio {

/// Throws InputError naming file, segment and point where the outline cannot be a head's: too few
/// points, a size that no tongue has (which usually means wrong units), a gap in a line, a tongue
/// that crosses itself or does not close about the hyoid, a palate that the tongue lies above.
/// Expects what facing_model() gives; check_outline_size() also what was read.
void check_outline(const SpeakerOutline& outline);

/// The part of these checks that holds whichever way the outline faces.
void check_outline_size(const SpeakerOutline& outline);

}  // namespace genio
