#pragma once
#include <string>

namespace genio {

/// Writes a whole text file. Throws InputError naming the path.
void write_text(const std::string& path, const std::string& text);

/// Replaces a file at once: an interruption leaves either the old text or the new. Writes PATH.new
/// on the way. Throws InputError naming the path.
void replace_text(const std::string& path, const std::string& text);

}  // namespace genio
