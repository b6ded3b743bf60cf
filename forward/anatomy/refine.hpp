#pragma once
#include "forward/algebra/supports.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// A mesh whose elements are each split into eight by the middles of edges, faces and volume.
struct RefinedMesh {
  HexMesh mesh;                   ///< the first nodes are the old ones
  std::vector<Support> supports;  ///< a new node has the one that all nodes it lies between share
  /// Of each old element its 3 x 3 x 3 nodes, i + 3 j + 9 k.
  std::vector<std::array<int, 27>> grids;
};

/// The support of a node that lies between others: between the jaw and another support it goes with
/// the other; between any support and a free node it is free.
Support support_between(const std::vector<Support>& parents);

/// Cell of 10 nm that a place lies in, to find nodes by where they are; off the grid of round
/// coordinates, so that these, and their means, lie inside cells.
std::array<long long, 3> place_cell(const Vec3& x);

RefinedMesh refined(const HexMesh& mesh, const std::vector<Support>& supports);

}  // namespace genio
