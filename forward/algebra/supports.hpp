#pragma once
// Which nodal displacements are free, and which move together.

#include <vector>

#include "forward/base/types.hpp"

namespace genio {

enum class Support : int {
  free = 0,
  fixed = 1,       ///< held in place: the jaw insertions
  horizontal = 2,  ///< one rigid body free to translate in x and y: the hyoid
  led = 3,         ///< an unknown that an effect leads along a path: the jaw insertions, opening
  body = 4,        ///< one rigid body free to translate: the hyoid on springs
  forward = 5,     ///< one rigid body free along x: the hyoid of half a tongue
  sagittal = 6,    ///< one rigid body free along x and z: the same on springs
  held = 8,        ///< from here on: held along x (+ 1), y (+ 2), z (+ 4), free along the others
};

/// A node held along some axes.
constexpr Support held_along(bool x, bool y, bool z) {
  return Support(int(Support::held) + x + 2 * y + 4 * z);
}

/// A node of the plane that half a tongue ends at.
constexpr Support in_midplane = held_along(false, true, false);

/// Maps the 3 n nodal displacements to the unknowns of the problem.
class DofMap {
 public:
  DofMap() = default;
  explicit DofMap(const std::vector<Support>& supports);

  int unknowns() const { return unknowns_; }
  /// Nodal displacement components, 3 n.
  Eigen::Index size() const { return Eigen::Index(index_.size()); }
  /// Unknown that moves displacement component `i` of 3 n; -1 where it is held.
  int unknown(int i) const { return index_[i]; }
  /// Displacements of all nodes from the unknowns.
  Vector expand(const Vector& unknowns) const;
  /// Unknowns of nodal displacements that respect the supports (expand's inverse).
  Vector pick(const Vector& nodal) const;
  /// Sum of nodal forces over each unknown (the transpose of expand).
  Vector reduce(const Vector& nodal) const;

 private:
  std::vector<int> index_;
  int unknowns_ = 0;
};

}  // namespace genio
