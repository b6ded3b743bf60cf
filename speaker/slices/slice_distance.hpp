#pragma once
#include <Eigen/Geometry>

#include "speaker/slices/flat_stack.hpp"

namespace genio {

/// Signed distance in a slice's plane to its outlines, negative inside. An outline within another
/// is a hole, whichever way each runs.
class SliceDistance {
 public:
  explicit SliceDistance(const std::vector<FlatOutline>& outlines);
  /// Distances along a line of v: at u[i], into out[i]; u rises [m].
  void row(const std::vector<double>& u, double v, float* out) const;
  bool inside(const Eigen::Vector2d& p) const;

 private:
  struct Chord {
    Eigen::Vector2d a, b;
  };
  /// Some chords in a row and their box.
  struct Bundle {
    Eigen::AlignedBox2d box;
    size_t first, last;
  };
  std::vector<Chord> chords_;
  std::vector<Bundle> bundles_;
};

}  // namespace genio
