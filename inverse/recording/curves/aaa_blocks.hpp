#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// AAA's exports whose header has one title for a block of columns: radii [mm] and angles [rad], or
/// X and Y in turn [mm], and confidences. Throws InputError naming file, line and field.
RawContours read_aaa_blocks(const std::string& path, const ReadOptions& options);

/// True where a header has titles of such blocks.
bool names_aaa_blocks(const std::string& header);

/// The same of a file's first line.
bool has_aaa_blocks(const std::string& path);

}  // namespace genio
