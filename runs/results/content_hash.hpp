#pragma once
#include <string>

namespace genio {

/// 16 hexadecimal digits of what a file holds, to tell whether it has changed; of a folder: of its
/// model.toml. What a TOML file names in quotes and stands beside it counts as its content. Throws
/// InputError naming a file that cannot be read.
std::string content_hash(const std::string& path);

}  // namespace genio
