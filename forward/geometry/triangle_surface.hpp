#pragma once
// Rigid surfaces (palate, jaw, hyoid) as triangles.

#include <array>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

struct TriangleSurface {
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<std::array<int, 3>> triangles;
};

/// Reads STL, OBJ or PLY (metres); quadrilaterals are split. Neighbouring triangles are turned to
/// agree in orientation. Throws InputError naming the file.
TriangleSurface read_surface(const std::string& path);

/// Writes Wavefront OBJ in metres.
void write_obj(const std::string& path, const TriangleSurface& surface);

/// Cut with the plane y = 0 as polylines of (x, z) [m], longest first.
std::vector<std::vector<Eigen::Vector2d>> midsagittal_cut(const TriangleSurface& surface);

}  // namespace genio
