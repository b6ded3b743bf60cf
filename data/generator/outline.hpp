#pragma once
// The generic tongue's shape as a few smooth curves through published landmarks. Millimetres here,
// as in the tables they come from; the generator converts once.

#include <Eigen/Core>
#include <vector>

namespace genio::generic {

using Point2 = Eigen::Vector2d;  ///< (x, z) [mm]

/// Smooth curve through points by chord length (natural cubic splines).
class Curve {
 public:
  explicit Curve(std::vector<Point2> points);
  /// Point at the fraction `u` of the length, 0 to 1.
  Point2 at(double u) const;
  /// Unit vector to the left of the curve's direction.
  Point2 left_normal(double u) const;
  double length() const { return length_; }

 private:
  Point2 raw(double t) const;
  std::vector<Point2> points_, bend_;  // bend_: second derivatives
  std::vector<double> knots_;
  std::vector<double> arc_;  // length up to each of equally spaced knot values
  double length_ = 0;
};

/// Value at `u` of the smooth (monotone between equal values) curve through (u_i, v_i).
double blend(const std::vector<Point2>& table, double u);

/// Midsagittal outline, from below the tip over tip, dorsum and root to the hyoid.
Curve surface_line();
/// Front of the tongue body: from the frenulum down the mental symphysis to the mouth floor.
Curve front_line();
/// Palate: incisors, alveolar ridge, vault, velum, pharyngeal wall.
Curve palate_line();
/// Inner face of the mandible in the midsagittal plane, from the lower edge to the incisors.
Curve jaw_line();

/// Half width of the tongue [mm]: `u` along the surface line, `depth` 0 at the front line and 1 at
/// the surface.
double half_width(double u, double depth);

}  // namespace genio::generic
