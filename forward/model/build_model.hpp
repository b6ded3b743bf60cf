#pragma once
// From what a model folder says to a model.

#include <string>

#include "forward/effects/anatomy.hpp"
#include "forward/model/model.hpp"
#include "forward/model/model_file.hpp"

namespace genio {

/// Builds the effects. `source` is named in errors.
Model build_model(const ModelDescription& description, const std::string& source);

/// The model with its rest configuration moved by these values, one a mode of anatomy. It shares
/// the pattern of couplings, so that workspaces serve both. It is made from the model's
/// description: what was changed by hand is not in it. Throws InputError where an element turns
/// inside out, or where the model has other effects than its description.
Model moved_model(const Model& model, const std::vector<double>& values);

/// What the effects of such a description are made from, those of a moved one with the shares of
/// the standing one's fibres.
Anatomy anatomy_of(const ModelDescription& description, const std::string& source,
                   const ModelDescription* standing = nullptr);

/// read_description and build_model.
Model read_model(const std::string& path);

}  // namespace genio
