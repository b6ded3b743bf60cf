#pragma once
// Lines of points in the midsagittal plane.

#include <vector>

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// A line through points with its arc length. Copies nothing of where it came from.
class Polyline {
 public:
  /// `points`: 2 or more [m].
  explicit Polyline(std::vector<Vec2> points);

  double length() const { return arc_.back(); }  ///< [m]
  const std::vector<Vec2>& points() const { return points_; }
  /// Arc length up to each point [m].
  const std::vector<double>& arc() const { return arc_; }
  /// The place at an arc length, which is held between the ends.
  Vec2 at(double s) const;
  /// The position among the points of an arc length, 1.5 between two, and back.
  double position(double s) const;
  double arc_at(double position) const;
  /// Unit tangent there.
  Vec2 tangent(double s) const;

  struct Foot {
    double s = 0;  ///< arc length [m]
    Vec2 place = Vec2::Zero();
    double distance = 0;  ///< [m]
  };
  /// The closest place between two arc lengths.
  Foot foot(const Vec2& q, double from, double to) const;
  Foot foot(const Vec2& q) const { return foot(q, 0, length()); }

 private:
  size_t segment(double s) const;

  std::vector<Vec2> points_;
  std::vector<double> arc_;
};

/// Whether the line from a to b crosses that from c to d. Ends that touch do not count.
bool sides_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Twice the area that a closed line runs about, positive counter-clockwise with x backwards as the
/// first axis and z as the second [m^2].
double doubled_area(const std::vector<Vec2>& closed);

}  // namespace genio
