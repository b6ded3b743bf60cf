#pragma once
#include "forward/mesh.hpp"
#include "forward/supports.hpp"

namespace genio {

/// A mesh whose elements are each split into eight by the middles of edges, faces and volume.
struct RefinedMesh {
  HexMesh mesh;                   ///< the first nodes are the old ones
  std::vector<Support> supports;  ///< a new node has the one that all nodes it lies between share
};

/// The support of a node that lies between others: between the jaw and another support it goes with
/// the other; between any support and a free node it is free.
Support support_between(const std::vector<Support>& parents);

RefinedMesh refined(const HexMesh& mesh, const std::vector<Support>& supports);

}  // namespace genio
