#pragma once
// What was measured of one tongue shape.

#include <Eigen/SparseCore>
#include <string>
#include <utility>
#include <vector>

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// A point of the midsagittal contour; its place along the tongue is not known.
struct CurvePoint {
  Vec2 position;  ///< (x, z) [m]
  double sigma;   ///< noise across the contour [m]
};

/// A point of the tissue that was followed: a marked point of the surface, as in electromagnetic
/// articulography, or one of a volume registration.
struct FleshPoint {
  std::vector<std::pair<int, double>> at;  ///< nodes and their shares
  Vec3 position;                           ///< [m]; y is NaN where it was not measured
  double sigma;                            ///< [m], each coordinate
  std::string name;

  Vec3 on(const Positions& x) const;
};

/// A point of the tongue's surface in 3D, of a slice or a scan; its place on the surface is not
/// known.
struct SurfacePoint {
  Vec3 position;  ///< [m]
  double sigma;   ///< [m]
  int slice = 0;  ///< points of one slice were traced in one go: their noise may hang together
};

struct Target {
  std::vector<CurvePoint> curve;
  std::vector<FleshPoint> flesh;
  std::vector<SurfacePoint> surface;
  /// Degrees of freedom of Student's t noise, whose outliers count little; 0: Gaussian noise.
  double outlier_dof = 0;

  bool empty() const { return curve.empty() && flesh.empty() && surface.empty(); }
  /// True where nothing was measured off the midsagittal plane: left and right cannot be told
  /// apart.
  bool midsagittal() const;
  /// Middle of its points in the midsagittal plane, (x, z) [m].
  Vec2 middle() const;
};

/// The midsagittal line of the shape `x` as a measurement of `count` points.
Target curve_target(const Model& model, const Positions& x, int count, double sigma);

}  // namespace genio
