#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// Where a surface is to stay finer: balls and boxes together.
struct KeptRegion {
  struct Ball {
    Vec3 centre;    ///< [m]
    double radius;  ///< [m]
  };
  std::vector<Ball> balls;
  std::vector<Eigen::AlignedBox3d> boxes;  ///< [m]

  bool empty() const { return balls.empty() && boxes.empty(); }
  bool holds(const Vec3& p) const { return reaches(p, 0); }
  /// True where some place within `radius` of p may lie in the region.
  bool reaches(const Vec3& p, double radius) const;
};

/// Of "X,Y,Z,R" (a ball), "X,Y,Z,X,Y,Z" (a box by two corners), or the path of a CSV with the
/// columns x_mm, y_mm, z_mm, radius_mm, a ball each row; all in millimetres. Throws InputError.
KeptRegion read_kept_region(const std::vector<std::string>& texts);

}  // namespace genio
