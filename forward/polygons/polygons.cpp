#include "forward/polygons/polygons.hpp"

#include <algorithm>
#include <filesystem>

#include "forward/base/input_file.hpp"
#include "forward/polygons/obj.hpp"
#include "forward/polygons/ply.hpp"
#include "forward/polygons/stl.hpp"

namespace genio {

Polygons read_polygons(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  const std::string bytes = read_file(path);
  if (ending == ".ply") return read_ply(path, bytes);
  if (ending == ".obj") return read_obj(path, bytes);
  if (ending == ".stl") return read_stl(path, bytes);
  if (bytes.starts_with("ply")) return read_ply(path, bytes);
  if (bytes.starts_with("solid")) return read_stl(path, bytes);
  throw InputError(path +
                   ": cannot be read as STL, OBJ or PLY; expected a name that ends in .stl, "
                   ".obj or .ply");
}

}  // namespace genio
