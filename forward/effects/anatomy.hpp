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
};

/// Nodes that are held so.
std::vector<int> nodes_with(const Anatomy& anatomy, Support support);

}  // namespace genio
