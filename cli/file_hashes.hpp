#pragma once
#include <map>
#include <string>

namespace genio::cli {

/// SHA-256 of every regular file of a model's folder, by its name, in hexadecimal digits. `model`:
/// the folder or its model.toml. Throws InputError naming a file that cannot be read.
std::map<std::string, std::string> model_file_hashes(const std::string& model);

}  // namespace genio::cli
