#pragma once
// Measured shapes in files of any known format.

#include "inverse/recording/base/contours.hpp"

namespace genio {

/// Reads a file of the format that the options name, or of the one that its first bytes, its ending
/// or its first line tell; contour_formats() lists them. Throws InputError naming file, line and
/// field, or the formats there are.
ContourFile read_contours(const std::string& path, const ReadOptions& options = {});

}  // namespace genio
