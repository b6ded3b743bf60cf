#pragma once
// The tongue's midsagittal surface line, linear in the nodal positions.

#include <string>
#include <vector>

#include "forward/model/model.hpp"

namespace genio {

using Vec2 = Eigen::Vector2d;  ///< (x, z) in the midsagittal plane [m]

/// The edges of the surface's faces in the midsagittal plane, over their rest chord length, so that
/// the contour and points of the surface are of one tongue. Corners are rounded: the mean over 1.5
/// mm on both sides, weighted by a triangle, is twice continuously differentiable and cuts a corner
/// of 20 degrees by 0.09 mm. It goes on straight beyond both ends. Linear in the nodal positions:
/// c(t) = sum_k w_k(t) x_k.
class TongueLine {
 public:
  explicit TongueLine(const Model& model);

  const std::vector<int>& nodes() const { return nodes_; }
  double length() const { return knots_[knots_.size() - 1]; }
  /// Rest chord length from the line's start to the tip node [m].
  double tip_parameter() const { return tip_; }

  /// Weights w_k(t), or those of a derivative: dc/dt (1), d2c/dt2 (2).
  Vector weights(double t, int derivative = 0) const;
  Vec2 point(const Positions& x, double t) const;
  /// (x, z) of the nodes, a column each: point(x, t) = control(x) weights(t).
  Eigen::Matrix2Xd control(const Positions& x) const;

  struct Closest {
    double t;         ///< parameter of the closest point [m along the rest chord]
    double distance;  ///< signed: positive where q lies outside the tongue [m]
    Vec2 normal;      ///< outward unit normal there
    double beyond;    ///< how far along the straight end, negative before the first node [m]
  };
  /// Closest point of the line to q. The distance is smooth in x and q wherever the closest point
  /// is unique; d distance / d x_k = -w_k(t) normal (the point's slide along the line does not
  /// count, as it is orthogonal to the normal).
  Closest closest(const Positions& x, const Vec2& q) const;

  /// The line as `count` points from end to end, equally spaced in t.
  std::vector<Vec2> sample(const Positions& x, int count) const;

 private:
  std::vector<int> nodes_;
  Vector knots_;
  Matrix dense_;  // weights at equally spaced parameters, one row each
  double tip_ = 0;
};

/// Name of the part of the tongue that a place of the shape `x` belongs to, by the fraction of the
/// way from tip to end of its closest point of the midsagittal line: underside, tip, blade, dorsum,
/// root.
std::string tongue_region(const TongueLine& line, const Positions& x, const Vec3& place);

}  // namespace genio
