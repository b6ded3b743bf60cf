#pragma once
#include "speaker/modes/outline_modes.hpp"

namespace genio {

/// Reads modes of outlines from a CSV with a row a point: stretch, point, x_mm, z_mm, apart_x_mm,
/// apart_z_mm, and MODE_x_mm, MODE_z_mm for each mode; a first line "# kept K, speakers N" tells
/// the rest. Modes named minorK have no name. Throws InputError naming file, row and column.
OutlineModes read_outline_modes(const std::string& path);

/// Writes such a file; `origin` is a comment of one line that says where the outlines come from.
void write_outline_modes(const OutlineModes& modes, const std::string& origin,
                         const std::string& path);

}  // namespace genio
