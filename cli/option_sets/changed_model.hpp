#pragma once
#include <string>
#include <vector>

#include "forward/model/model.hpp"

namespace genio::cli {

/// What the command line changes in a model.
struct ModelChanges {
  std::vector<std::string> effects;  ///< "NAME.param=VALUE", in SI units
  std::vector<std::string> without;  ///< effects that are left out
};

/// The description with the effects that the command line leaves out, switches on or changes.
/// Throws InputError naming the option.
ModelDescription changed_description(ModelDescription description, const ModelChanges& changes);

/// The model of a file with the effects that the command line leaves out, switches on or changes.
/// Throws InputError naming the option.
Model changed_model(const std::string& model, const ModelChanges& changes);

/// Default parameters with the commands "NAME=NEWTONS" set. Throws InputError naming the option.
Parameters commanded(const Model& model, const std::vector<std::string>& forces);

}  // namespace genio::cli
