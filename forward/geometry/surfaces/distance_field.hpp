#pragma once
// A signed distance as a smooth function: samples on grids, blended by cubic B-splines.

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "forward/geometry/surfaces/bone_distance.hpp"
#include "forward/geometry/surfaces/cubic_blend.hpp"

namespace genio {

/// Twice continuously differentiable signed distance to a bone where its surface is near,
/// so that contact energies have exact forces and stiffness even at its edges. A coarse grid over
/// the whole box tells what is far. Near the surface a grid of a quarter of its spacing is filled
/// in bricks, each when it is first asked for: of the bone's surface the tongue touches little.
/// The fine coefficients are samples less a sixth of their second differences (a quasi-interpolant:
/// cubic polynomials are reproduced), so a smooth surface stays where it is; an edge is rounded
/// over about the fine spacing. May be asked from several threads.
class DistanceField {
 public:
  static constexpr double touch = 4e-4;  ///< what is nearer is asked for exactly [m]

  /// Samples within the box, positive on the side that the surface's normals point to.
  DistanceField(const TriangleSurface& surface, const Vec3& low, const Vec3& high, double spacing);
  ~DistanceField();

  /// Near the surface the smooth distance; elsewhere within the coarse grid's error of it, and
  /// outside the box a large positive constant [m].
  double value(const Vec3& p) const;
  DistanceSample sample(const Vec3& p) const;
  /// The same where it may be less than `touch`; elsewhere perhaps only some larger number [m].
  double value_if_touching(const Vec3& p) const;
  /// By the coarse grid alone [m].
  double rough(const Vec3& p) const;
  /// A lower bound of the value within `radius` about p, without filling in what is fine [m]; no
  /// more than 8 mm.
  double at_least(const Vec3& p, double radius) const;
  /// Without the spline [m].
  const BoneDistance& exact() const { return distance_; }

  /// A cell of the fine grid by its first node, and a place within it, 0 to 1.
  struct Cell {
    std::array<int, 3> node;
    Vec3 fraction;
  };
  /// The cell of a point; none outside the box.
  std::optional<Cell> cell(const Vec3& p) const;
  /// Where a node of the fine grid lies [m].
  Vec3 node(const std::array<int, 3>& number) const {
    return low_ + fine_ * Vec3(number[0], number[1], number[2]);
  }
  double fine_spacing() const { return fine_; }
  /// Low corner of the box, a node of both grids [m].
  const Vec3& low() const { return low_; }

 private:
  struct Brick;
  struct Spot;
  /// What linear interpolation may be off by: no distance changes faster than the way [m].
  double coarse_error() const { return 0.87 * spacing_; }
  bool locate(const Vec3& p, Spot& spot) const;
  /// The brick of a spot, where it has been made.
  const Brick* there(const Spot& spot) const;
  const Brick& brick(const Spot& spot) const;
  std::unique_ptr<Brick> make_brick(const std::array<int, 3>& index) const;
  double fine(const Vec3& p) const;
  double at(int i, int j, int k) const { return samples_[(size_t(k) * ny_ + j) * nx_ + i]; }

  BoneDistance distance_;
  Vec3 low_;
  double spacing_, fine_;
  int nx_, ny_, nz_, bx_, by_, bz_;
  std::vector<double> samples_;
  mutable std::vector<std::atomic<const Brick*>> bricks_;
  mutable std::mutex filling_;
  /// Samples at nodes of the fine grid, by the node's number: neighbouring bricks share them.
  mutable std::unordered_map<int64_t, float> fine_samples_;
};

}  // namespace genio
