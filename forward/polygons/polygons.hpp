#pragma once
// Surfaces as files hold them: points, and faces of three or more corners.

#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

struct Polygons {
  std::vector<Vec3> points;  ///< in single precision, as most of these files have
  std::vector<int> corners;  ///< point numbers of all faces, one face after another
  std::vector<size_t> ends;  ///< one past each face's last corner
  bool in_order =
      false;  ///< neighbours in `points` are neighbours on the surface, as a scanner has them

  void close_face() { ends.push_back(corners.size()); }
};

/// Reads PLY (ASCII, binary of either byte order), OBJ or STL (ASCII, binary) by the ending of the
/// name, else by the first bytes. Sizes that a file claims are held against its length before
/// anything is made of them. Throws InputError naming file, line or byte, and what is wrong.
Polygons read_polygons(const std::string& path);

}  // namespace genio
