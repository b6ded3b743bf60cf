#pragma once
#include <string>
#include <vector>

#include "forward/algebra/supports.hpp"
#include "forward/effects/description.hpp"
#include "forward/geometry/mesh.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// What effects are made from: the description with the muscles' segments, and what several need.
struct Anatomy {
  const ModelDescription& description;
  const std::string& source;      ///< named in errors
  std::vector<Muscle> muscles;    ///< with segments
  std::vector<Support> supports;  ///< as the effects present want them
  NodeMatrix mass;                ///< of the tissue
  /// The model as it stands, where this is its rest configuration moved along modes of anatomy;
  /// null: this is it. What is chosen by steps, such as the points that may touch a bone, is chosen
  /// there, so that energies are smooth in the modes' values.
  const ModelDescription* standing = nullptr;
};

/// Nodes that are held so.
std::vector<int> nodes_with(const Anatomy& anatomy, Support support);

}  // namespace genio
