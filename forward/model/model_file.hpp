#pragma once
// A model on disk: a folder with model.toml, mesh.vtu, fibres.vtp and surfaces.

#include <map>
#include <string>

#include "forward/effects/description.hpp"

namespace genio {

/// Reads a model folder or the path of its model.toml. Throws InputError naming file and line.
ModelDescription read_description(const std::string& path);

/// Writes the folder; creates it where it does not exist.
void write_description(const ModelDescription& description, const std::string& folder);

}  // namespace genio
