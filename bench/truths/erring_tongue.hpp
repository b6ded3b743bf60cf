#pragma once
// A tongue that is not the model's, solved to make targets.

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "bench/truths/erring_truth.hpp"
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

/// The tongue of that fault by the first of the seeds from `seed` on by which it can be built:
/// turned fibres may turn an element inside out. Throws InputError after twenty.
std::unique_ptr<ErringTongue> erring_tongue(const ModelDescription& model, ModelFault fault,
                                            unsigned seed);

}  // namespace genio::bench
