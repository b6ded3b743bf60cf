#pragma once
// What is hidden in a data set, at any strength.

#include <functional>
#include <map>
#include <random>

#include "forward/model/model_file.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio::bench {

/// A change of the tongue that grows with a number s >= 0.
struct HiddenChange {
  std::string effect;  ///< as the workflow should name it; "lump", "tether": in no library
  std::string where;
  bool in_library = true;
  bool symmetric = true;        ///< of both sides alike
  bool drawn = false;           ///< at a random place: another draw is another change
  double first = 1, most = 10;  ///< s to try first, and the largest that makes sense
  /// The tongue as it is, and as the model file has it.
  std::function<ModelDescription(ModelDescription, double)> truth, shipped;
  /// What is added to the model of the truth by hand; may be empty.
  std::function<Model(const Model&, double)> by_hand;
  /// How the data are laid wrongly.
  std::function<HeadPose(double)> pose;
  /// The effect's parameters, as an answer should have them.
  std::function<std::map<std::string, double>(double)> parameters;
};

/// The changes that can be hidden; "lump" and "tether" are in no library.
const std::vector<std::string>& hidden_names();

/// One at a random place. `active`: the muscles of the data set's postures, most used first. Where
/// forces are not known and both sides are commanded alike, a weak muscle is one of one side.
HiddenChange hidden_change(const std::string& name, const ModelDescription& tongue,
                           const std::vector<std::string>& active, bool forces_known,
                           std::mt19937& random);

}  // namespace genio::bench
