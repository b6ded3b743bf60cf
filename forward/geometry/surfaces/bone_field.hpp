#pragma once
#include <memory>

#include "forward/geometry/mesh.hpp"
#include "forward/geometry/surfaces/distance_field.hpp"

namespace genio {

/// The distance to the bone of a surface wherever a tongue of this mesh may touch it. The latest
/// few are kept, as models that differ in other effects have the same.
std::shared_ptr<const DistanceField> bone_field(const TriangleSurface& surface,
                                                const HexMesh& mesh);

}  // namespace genio
