#pragma once
// A tongue that is not the model's, solved to make targets.

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "forward/model/build_model.hpp"
#include "forward/model/mirror.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {

/// Solved on its right half where it is its own mirror image. Not for several threads.
class ErringTongue {
 public:
  /// Throws InputError where it cannot be built.
  ErringTongue(const ModelDescription& description, const std::string& name)
      : whole_(build_model(description, name)), mirror_(mirror_of(whole_)), workspace_(solved()) {}

  const Model& whole() const { return whole_; }
  /// The shape of the whole tongue under forces by bilateral name [N], all other parameters as the
  /// description has them. Empty where there is no equilibrium.
  std::optional<Positions> shape(const std::map<std::string, double>& forces);

 private:
  const Model& solved() const { return mirror_ ? mirror_->half : whole_; }

  Model whole_;
  std::unique_ptr<const Mirror> mirror_;
  Workspace workspace_;
};

}  // namespace genio::bench
