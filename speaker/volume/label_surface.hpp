#pragma once
#include "forward/geometry/triangle_surface.hpp"
#include "speaker/volume/label_volume.hpp"

namespace genio {

/// The closed surface about a label, with normals outwards: voxels are blurred by a Gaussian of 0.7
/// voxels, which takes the steps off and leaves a plate of one voxel. The surface lies near the
/// half, at the level where it holds the voxels' volume. Empty where a label is so thin that
/// nothing reaches it.
TriangleSurface label_surface(const LabelledBox& box);

}  // namespace genio
