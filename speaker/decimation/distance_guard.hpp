#pragma once
#include "forward/geometry/surfaces/closest_point.hpp"
#include "speaker/decimation/collapsing_mesh.hpp"
#include "speaker/solid/kept_region.hpp"

namespace genio {

/// How much a deviation counts: that in the region as many times as the bounds differ.
struct DeviationScale {
  double kept;  ///< factor in the region, >= 1
  const KeptRegion* region;
  double at(const Vec3& p) const { return region->holds(p) ? kept : 1; }
};

/// Tells how far a surface goes from what it was, both ways, by places on both. Of the first
/// surface vertices and centres, at most 30 000, each belong to a triangle of the present one, and
/// are measured to the triangles about. Of new triangles ten places are measured to the first
/// surface.
class DistanceGuard {
 public:
  /// `present`: the triangles that the mesh begins with.
  DistanceGuard(const TriangleSurface& first, const TriangleSurface& present,
                const DeviationScale& scale);
  /// The largest scaled deviation about with a and b joined at `at` [m]; some number above `most`
  /// where it exceeds that.
  double deviation(const CollapsingMesh& mesh, int a, int b, const Vec3& at, double most);
  /// What was measured last is done, and was not above its most.
  void done();

 private:
  struct Home {
    int sample, triangle;
  };
  SurfaceDistance distance_;
  DeviationScale scale_;
  std::vector<Vec3> sample_;
  std::vector<double> sample_scale_;
  std::vector<std::vector<int>> samples_;  ///< by triangle
  std::vector<Home> homes_;                ///< where samples would go
  std::vector<int> left_;                  ///< triangles that they leave
};

}  // namespace genio
