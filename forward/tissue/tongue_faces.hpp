#pragma once
// Which faces of the mesh are the tongue's own surface.

#include <vector>

#include "forward/algebra/supports.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// A node that moves by itself: free, or free within the plane that half a tongue ends at.
bool moves_freely(Support support);
/// Boundary faces, without those of the plane that half a tongue ends at.
std::vector<Quad> outer_faces(const HexMesh& mesh, const std::vector<Support>& supports);
/// Faces of the tongue's own surface: outer faces without a supported node.
std::vector<Quad> free_faces(const HexMesh& mesh, const std::vector<Support>& supports);

}  // namespace genio
