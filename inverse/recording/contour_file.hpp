#pragma once
// Measured shapes in files of any known format.

#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Reads a file of the format that the options name, or of the one that its first bytes, its ending
/// or its first line tell; contour_formats() lists them. Throws InputError naming file, line and
/// field, or the formats there are.
RawContours read_raw(const std::string& path, const ReadOptions& options = {});

/// The same in metres with x backwards and z up, as far as the file and the caller tell.
ContourFile read_contours(const std::string& path, const ReadOptions& options = {});

}  // namespace genio
