#pragma once
#include "runs/frames/measured.hpp"

namespace genio {

/// Refuses options of how a file is read that do not apply to it: an option is never ignored in
/// silence. `registered`: the format itself is in the model's frame. Throws InputError naming the
/// option and why it does not apply.
void refuse_unused(const MeasuredOptions& o, const FormatTraits& format, bool registered);

/// The same for --mm-per-px where the format itself says of its numbers that they are no pixels.
void refuse_unused_pixels(const MeasuredOptions& o, const FileAxes& axes);

/// The same for --noise-mm where every point has a noise of its own.
void refuse_unused_noise(const MeasuredOptions& o, const std::vector<ContourFrame>& frames);

}  // namespace genio
