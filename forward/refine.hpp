#pragma once
#include "forward/mesh.hpp"
#include "forward/supports.hpp"

namespace genio {

/// A mesh whose elements are each split into eight by the middles of edges, faces and volume.
struct RefinedMesh {
  HexMesh mesh;                   ///< the first nodes are the old ones
  std::vector<Support> supports;  ///< a new node has the one that all nodes it lies between share
};

RefinedMesh refined(const HexMesh& mesh, const std::vector<Support>& supports);

}  // namespace genio
