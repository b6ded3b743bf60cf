#pragma once
#include <memory>

#include "forward/geometry/distance_field.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// The distance to a rigid surface wherever a tongue of this mesh may touch it. The latest few are
/// kept, as models that differ in other effects have the same.
std::shared_ptr<const DistanceField> field_about(const TriangleSurface& surface,
                                                 const HexMesh& mesh);

}  // namespace genio
