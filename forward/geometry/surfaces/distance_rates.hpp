#pragma once
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "forward/geometry/surfaces/distance_field.hpp"

namespace genio {

/// How the smooth distance of a field changes as the vertices of its surface move along several
/// displacement fields at once, the grid's nodes staying where they are. A sample of the distance
/// changes by -n.U at the foot of its node (the foot itself slides along the surface), and the
/// spline is linear in its samples. Behind the rim of an open surface, where the bone's depth
/// counts too, U is taken as uniform.
class DistanceRates {
 public:
  /// `surface`: that of the field, each of the `fields` with a displacement a vertex [m]. All must
  /// outlive this.
  DistanceRates(const DistanceField& field, const TriangleSurface& surface,
                std::vector<const std::vector<Vec3>*> fields)
      : field_(field), surface_(surface), fields_(std::move(fields)) {}

  struct Rates {
    Vector value;     ///< of the distance at a point, by each field [m]
    Matrix gradient;  ///< of its gradient, 3 x fields
  };
  /// At a point where the field's fine grid is; zero outside.
  Rates at(const Vec3& p);

 private:
  using Node = std::array<int, 3>;
  const Vector& sample(const Node& node);
  Vector coefficient(const Node& node);

  const DistanceField& field_;
  const TriangleSurface& surface_;
  std::vector<const std::vector<Vec3>*> fields_;
  std::unordered_map<int64_t, Vector> samples_, coefficients_;
  int near_ = -1;
};

}  // namespace genio
