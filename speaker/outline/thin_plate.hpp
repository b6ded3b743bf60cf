#pragma once
// A smooth map of the midsagittal plane through pairs of places.

#include <vector>

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// A place and where it goes [m].
struct PlacePair {
  Vec2 from, to;
};

/// A pair whose place may slide: a line tells across itself where a place goes, hardly along it.
struct SlidingPair {
  Vec2 from, to;
  Vec2 along = Vec2::Zero();  ///< unit vector of the line; zero: it may not slide
  double held = 0;            ///< part of the weight that counts along it all the same
};

/// The thin-plate spline (Bookstein 1989): of all maps that take every `from` to its `to`, the one
/// of least bending energy; affine maps bend nothing. With `smoothing` the pairs are met within
/// some distance instead and the map is stiffer. It need not be invertible: see least_stretch().
class ThinPlateMap {
 public:
  /// The identity.
  ThinPlateMap() = default;
  /// `pairs`: 3 or more, not all in one line; those whose `from` repeats are left out. `smoothing`
  /// weighs bending against squared distances, in units of the pairs' size.
  explicit ThinPlateMap(const std::vector<PlacePair>& pairs, double smoothing = 0);
  /// The map that bends least of those that meet the pairs as far as they hold (Rohr et al. 2001,
  /// anisotropic landmarks). `smoothing` above 0; 3 pairs or more with places of their own.
  ThinPlateMap(const std::vector<SlidingPair>& pairs, double smoothing);

  Vec2 operator()(const Vec2& p) const;
  /// Midsagittal places move so; y is multiplied by `lateral`.
  Vec3 in_space(const Vec3& p, double lateral) const;
  Eigen::Matrix2d derivative(const Vec2& p) const;

 private:
  /// Centre and size of the places.
  void lay(const std::vector<Vec2>& from);

  Vec2 centre_ = Vec2::Zero();
  double size_ = 1;
  std::vector<Vec2> places_;  ///< in units of the size, about the centre
  Eigen::Matrix2Xd weights_;  ///< a column a place [m]
  Eigen::Matrix<double, 2, 3> affine_ =
      (Eigen::Matrix<double, 2, 3>() << 0, 1, 0, 0, 0, 1).finished();
};

/// The smallest determinant of the map's derivative at the places: below 0 it folds there.
double least_stretch(const ThinPlateMap& map, const std::vector<Vec2>& places);

/// The affine map closest to the pairs (least squares).
ThinPlateMap affine_map(const std::vector<PlacePair>& pairs);

}  // namespace genio
