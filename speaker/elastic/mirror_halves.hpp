#pragma once
#include "forward/geometry/mesh.hpp"

namespace genio {

/// The right half of a mesh that is its own mirror image, to find shapes that are so too.
struct MirrorHalves {
  HexMesh half;              ///< elements on the right (y > 0)
  std::vector<int> whole;    ///< the mesh's node for each of the half
  std::vector<int> in_half;  ///< the half's node for each of the mesh: itself or its image
  std::vector<bool> left;    ///< of the mesh's nodes

  /// A shape of the half on both sides, exactly symmetric.
  Positions on_both(const Positions& of_half) const;
};

/// Empty elements where a node has no image within 10 micrometres.
MirrorHalves mirror_halves(const HexMesh& mesh);

}  // namespace genio
