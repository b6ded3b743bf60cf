#pragma once
// Closest points on triangles.

#include <array>
#include <memory>

#include "forward/geometry/triangle_surface.hpp"

namespace genio {

/// Barycentric coordinates of the point of triangle (a, b, c) closest to p (Ericson 2005,
/// Real-Time Collision Detection, section 5.1.5).
std::array<double, 3> closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c);

/// Signed distance to a surface: positive on the side its normals point to. A point that is
/// closest to the rim of an open surface counts as outside.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const TriangleSurface& surface);
  ~SurfaceDistance();
  /// [m]
  double operator()(const Vec3& p) const;
  /// The same; `near` is a triangle that lies near, or -1, and becomes the closest one. Points
  /// that follow one another are found quickly so.
  double operator()(const Vec3& p, int& near) const;

  struct Foot {
    Vec3 place;  ///< of the surface's point closest to p [m]
    Vec3
        normal;  ///< of the face, edge or vertex that it lies on, not of length 1 at the latter two
    bool on_rim;  ///< at the end of an open surface
  };
  Foot foot(const Vec3& p) const {
    int near = -1;
    return foot(p, near);
  }
  Foot foot(const Vec3& p, int& near) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace genio
