#pragma once
// From what a model folder says to a model.

#include <string>

#include "forward/model/model.hpp"
#include "forward/model/model_file.hpp"

namespace genio {

/// Builds the effects. `source` is named in errors.
Model build_model(const ModelDescription& description, const std::string& source);

/// read_description and build_model.
Model read_model(const std::string& path);

}  // namespace genio
