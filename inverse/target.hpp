#pragma once
// What was measured of one tongue shape, and how far a shape is from it.

#include <string>
#include <utility>
#include <vector>

#include "inverse/tongue_line.hpp"

namespace genio {

/// A point of the midsagittal contour; its place along the tongue is not known.
struct CurvePoint {
  Vec2 position;  ///< (x, z) [m]
  double sigma;   ///< noise across the contour [m]
};

/// A marked point of the tongue, as in electromagnetic articulography.
struct FleshPoint {
  int node;
  Vec3 position;  ///< [m]; y is NaN where it was not measured
  double sigma;   ///< [m], each coordinate
  std::string name;
};

/// A point of the tongue's surface in 3D; its place on the surface is not known.
struct SurfacePoint {
  Vec3 position;  ///< [m]
  double sigma;   ///< [m]
};

struct Target {
  std::vector<CurvePoint> curve;
  std::vector<FleshPoint> flesh;
  std::vector<SurfacePoint> surface;
  bool empty() const { return curve.empty() && flesh.empty() && surface.empty(); }
  /// True where nothing was measured off the midsagittal plane: left and right cannot be told
  /// apart.
  bool midsagittal() const;
};

/// The midsagittal line of the shape `x` as a measurement of `count` points.
Target curve_target(const Model& model, const Positions& x, int count, double sigma);

/// Noise-weighted residuals and their derivative with respect to the nodal positions.
struct Residuals {
  Vector values;  ///< distance over sigma
  std::vector<std::vector<std::pair<int, Vec3>>>
      gradient;              ///< d value / d x_node [1/m], a row each
  Vector distances;          ///< unweighted, one a point [m]
  std::vector<Vec3> places;  ///< where on the model, one a point [m]
  double rms = 0, max = 0;   ///< of distances [m]
};

/// Compares shapes with a target. Const; serves any number of threads.
class Comparison {
 public:
  Comparison(const Model& model, Target target);
  Residuals operator()(const Positions& x) const;
  const Target& target() const { return target_; }
  const TongueLine& line() const { return line_; }

 private:
  void compare_surface(const Positions& x, Residuals& r) const;

  const Model* model_;
  Target target_;
  TongueLine line_;
};

/// d residuals / d parameters: rows as in Residuals, `positions` = dx/dp (3 n x count).
Matrix residual_jacobian(const Residuals& residuals, const Matrix& positions);

}  // namespace genio
