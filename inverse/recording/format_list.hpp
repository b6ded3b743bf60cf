#pragma once
#include <vector>

#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// All formats, in the order in which a file is held against them.
const std::vector<ContourFormat>& contour_formats();

/// The format of that name; "ema" is whichever of sensors a file has. Throws InputError that
/// suggests the nearest name.
const ContourFormat& format_named(const std::string& name);

/// The format of a file by its first bytes, ending or first line; of those of sensors where the
/// options name sensors. Throws InputError naming `path` where none knows it.
const ContourFormat& format_of(const std::string& path, const ReadOptions& options = {});

/// "auto, ema, ssff, ... or csv": what --format takes.
std::string format_choices();

}  // namespace genio
