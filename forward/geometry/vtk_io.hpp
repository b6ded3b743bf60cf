#pragma once
// VTK XML files (.vtu unstructured grids, .vtp polygonal data) that ParaView opens.

#include <map>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// A named array of a VTK file: `components` values a tuple.
struct VtkArray {
  int components = 1;
  std::vector<double> values;
  bool integer = false;
};

/// Points, cells (as lists of point numbers) and arrays on both. VTK cell types: 12 hexahedron,
/// 4 polyline, 9 quad.
struct VtkData {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> cells;
  std::vector<int> types;
  std::map<std::string, VtkArray> point_data, cell_data;
};

/// Reads .vtu (cells with types) or .vtp (lines). Arrays in ascii or inline uncompressed base64.
/// Throws InputError naming the file and the element.
VtkData read_vtk(const std::string& path);

/// Writes an unstructured grid as ascii .vtu.
void write_vtu(const std::string& path, const VtkData& data);

/// Writes polylines as ascii .vtp.
void write_vtp_lines(const std::string& path, const VtkData& data);

}  // namespace genio
