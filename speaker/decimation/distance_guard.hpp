#pragma once
#include "forward/geometry/surfaces/closest_point.hpp"
#include "speaker/decimation/collapsing_mesh.hpp"
#include "speaker/solid/kept_region.hpp"

namespace genio {

/// How far a decimated surface may lie from the one before [m].
struct DistanceBounds {
  double elsewhere, kept;
  const KeptRegion* region;
  double at(const Vec3& p) const { return region->holds(p) ? kept : elsewhere; }
};

/// Keeps a surface near to what it was, both ways, by places on both: each vertex of the first
/// surface belongs to a triangle of the present one, and must stay near some triangle about; of new
/// triangles the corners, the middles of the sides and the centre must stay near the first surface.
class DistanceGuard {
 public:
  DistanceGuard(const TriangleSurface& first, const DistanceBounds& bounds);
  /// True where a and b may be joined at `at`.
  bool allows(const CollapsingMesh& mesh, int a, int b, const Vec3& at);
  /// What was allowed last is done; to be called before the mesh changes.
  void done();

 private:
  struct Home {
    int sample, triangle;
  };
  const TriangleSurface& first_;
  SurfaceDistance distance_;
  DistanceBounds bounds_;
  std::vector<std::vector<int>> samples_;  ///< by triangle: vertices of the first surface
  std::vector<double> bound_;              ///< by vertex of the first surface
  std::vector<Home> homes_;                ///< where samples would go
  std::vector<int> left_;                  ///< triangles that they leave
};

}  // namespace genio
