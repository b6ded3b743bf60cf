#pragma once
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// The outlines of one slice, each closed from its last point to its first.
struct StackSlice {
  std::string name;  ///< as the file calls it
  std::vector<std::vector<Vec3>>
      outlines;  ///< [m]; at least 3 points each, no two the same in turn
};

/// Segmented slices in the file's order.
struct ContourStack {
  std::vector<StackSlice> slices;
  std::string source;  ///< for messages
};

/// Reads a CSV with the columns slice, point, x_mm, y_mm, z_mm, and perhaps contour where a slice
/// has several; without it, points that are counted anew begin another. A first point that is
/// repeated at the end is left out. Throws InputError naming the row and what was expected.
ContourStack read_contour_stack(const std::string& path);

}  // namespace genio
