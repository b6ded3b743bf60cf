#pragma once
// How far a point is from a bone of which a surface is known.

#include <utility>
#include <vector>

#include "forward/geometry/surfaces/closest_point.hpp"
#include "forward/geometry/triangle_surface.hpp"

namespace genio {

/// The surface with the normals of each connected part towards the tongue; `inside_points` (the
/// tongue at rest) decide.
TriangleSurface facing_tongue(TriangleSurface surface, const std::vector<Vec3>& inside_points);

/// Signed distance to a bone, negative inside. A closed part of the surface is the bone's whole
/// boundary. An open part is its face towards the tongue: the bone behind it is as deep as the rim
/// is far, and no deeper than 8 mm. So it ends in an edge at the rim as a tooth does, no point near
/// there jumps from inside to outside, and what lies far behind is outside again.
class BoneDistance {
 public:
  /// `surface`: with normals towards the tongue.
  explicit BoneDistance(const TriangleSurface& surface);
  /// [m]; `near`: as for SurfaceDistance.
  double operator()(const Vec3& p, int& near) const;
  double operator()(const Vec3& p) const {
    int near = -1;
    return (*this)(p, near);
  }
  /// The same for a point whose foot is known to lie on the triangle `near`.
  double from(const SurfaceDistance::Foot& foot, const Vec3& p, int near) const;
  /// To the surface as it was given, on whichever side and however far behind [m].
  const SurfaceDistance& face() const { return face_; }

 private:
  /// Of the bone behind a place of an open part [m].
  double depth(const Vec3& place) const;

  SurfaceDistance face_;
  std::vector<std::pair<Vec3, Vec3>> rim_;  ///< edges of open parts [m]
  std::vector<bool> open_;                  ///< by triangle
};

}  // namespace genio
