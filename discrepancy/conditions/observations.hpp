#pragma once
// Measured shapes under several conditions, and what is known of each.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "forward/base/parameter_name.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/prior/prior.hpp"
#include "inverse/target/target.hpp"

namespace genio {

/// One posture, load or orientation.
struct Condition {
  std::string name;
  Target target;  ///< points without a noise of their own have the observations'
  /// Known commands [N] and their standard deviations; those not named are 0. Unset: unknown.
  std::optional<std::map<std::string, Normal>> forces;
  std::map<ParameterName, double> effects;  ///< known values: "jaw_opening.angle"
  bool heldout = false;                     ///< never fitted
};

struct Observations {
  double noise = 0;              ///< standard deviation of a point across the surface [m]
  double noise_correlation = 0;  ///< length along a contour [m]; 0: points err by themselves
  bool bilateral = true;         ///< unknown commands drive both sides alike
  double effort_sd = Prior{}.effort_sd;    ///< of an unknown activation about 0
  std::optional<HeadPosePrior> head_pose;  ///< of each condition, estimated along where set
  std::vector<Condition> conditions;
};

/// Reads the TOML file `path` (see docs/discover.md). Flesh points are looked up in `model`.
/// Throws InputError naming file, line and field.
Observations read_observations(const std::string& path, const Model& model);

/// "jaw_opening" alone means its EffectKind::main. Throws InputError naming `source` for
/// what the library of effects has not.
ParameterName effect_parameter(const std::string& name, const std::string& source);

/// The description with an effect's parameter set, the effect added at vanishing strength where it
/// has none.
ModelDescription with_parameter(ModelDescription description, const ParameterName& name,
                                double value);

}  // namespace genio
