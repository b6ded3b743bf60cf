#pragma once
#include <memory>

#include "forward/geometry/mesh.hpp"
#include "forward/geometry/surfaces/distance_field.hpp"

namespace genio {

/// The distance to the bone of a surface wherever a tongue of this mesh may touch it. The latest
/// few are kept, as models that differ in other effects have the same.
std::shared_ptr<const DistanceField> bone_field(const TriangleSurface& surface,
                                                const HexMesh& mesh);

/// The field of a surface that has moved, and its tongue with it. The nodes of its grids lie where
/// those of the standing field do, so that its values are smooth in the motion. It is not kept.
std::shared_ptr<const DistanceField> moved_bone_field(const DistanceField& standing,
                                                      const TriangleSurface& surface,
                                                      const HexMesh& mesh);

}  // namespace genio
