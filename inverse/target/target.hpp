#pragma once
// What was measured of one tongue shape.

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// How much longer than the model's another speaker's line may be at either end: of lines of one
/// length, what lies behind the highest point differs by 4.1 mm between 41 speakers (standard
/// deviation; Serrurier & Neuschaefer-Rube 2023) [m].
inline constexpr double longer_line = 4.1e-3;

/// A point of the midsagittal contour; its place along the tongue is not known.
struct CurvePoint {
  Vec2 position;      ///< (x, z) [m]
  double sigma;       ///< noise across the contour [m]
  double longer = 0;  ///< how far past the end of the model's line it costs nothing [m]

  /// What counts of lying `beyond` the end [m].
  double past_end(double beyond) const {
    return std::copysign(std::max(0.0, std::abs(beyond) - longer), beyond);
  }
  /// Its standard deviation: where a contour ends is a matter of who traced it, to some 2 mm [m].
  double past_end_sigma() const { return std::hypot(sigma, 2e-3); }
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
