#pragma once
// The tongue's surface between its nodes.

#include <array>
#include <vector>

#include "forward/base/types.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// A quarter of a quad: the triangle of its first two nodes and the mean of all four. A fan about
/// the middle is the same in the mirror; a diagonal is not, and where a quad is warped the two
/// surfaces are half a millimetre apart.
using Facet = std::array<int, 4>;

std::vector<Facet> facets(const std::vector<Quad>& surface);

/// Corners of the triangle in a shape.
std::array<Vec3, 3> corners_of(const Facet& facet, const Positions& x);

/// Shares of a facet's nodes in the point of the triangle with barycentric coordinates `w`.
std::array<double, 4> node_shares(const std::array<double, 3>& w);

/// The point of a triangle closest to another.
struct Foot {
  std::array<double, 3> weight;  ///< barycentric
  Vec3 place;
  double square;  ///< of the distance [m^2]
};

/// Facets in one shape. Holds a reference to them.
class FacetSurface {
 public:
  FacetSurface(const std::vector<Facet>& facets, const Positions& x);

  const Facet& nodes(size_t facet) const { return facets_[facet]; }
  const std::array<Vec3, 3>& corners(size_t facet) const { return corners_[facet]; }
  Foot foot(size_t facet, const Vec3& q) const;
  /// The facet closest to q of all there are. A tree over a moving surface of a few hundred would
  /// not pay.
  size_t nearest(const Vec3& q) const;
  /// At least all facets within that distance of q.
  std::vector<size_t> within(const Vec3& q, double distance) const;

 private:
  bool beyond(size_t facet, const Vec3& q, double distance) const;

  const std::vector<Facet>& facets_;
  std::vector<std::array<Vec3, 3>> corners_;
  std::vector<Vec3> middle_;
  std::vector<double> radius_;  // about the middle
};

}  // namespace genio
