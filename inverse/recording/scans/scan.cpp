#include "inverse/recording/scans/scan.hpp"

#include <fmt/format.h>

#include "forward/geometry/triangle_surface.hpp"

namespace genio {
namespace {

constexpr size_t enough = 400;  // points of a scan

/// The vertices of a surface, at most some hundreds of them evenly through the file: neighbours
/// say nearly the same.
RawContours read(const std::string& path, const ReadOptions&) {
  const TriangleSurface scan = read_surface(path);
  RawContours raw{{}, FileAxes{"", "left", "up"}};
  raw.file.model_frame = false;
  ContourFrame& frame = raw.file.frames.emplace_back();
  frame.number = 1;
  const size_t stride = (scan.vertices.size() + enough - 1) / enough;
  for (size_t k = 0; k < scan.vertices.size(); k += stride)
    frame.points.push_back({scan.vertices[k], 0, "surface"});
  raw.file.remarks.push_back(
      fmt::format("{} of {} vertices of the scan, taken as points of the tongue's surface",
                  frame.points.size(), scan.vertices.size()));
  return raw;
}

bool known_by_bytes(const FileStart& start) {
  return start.ending == ".ply" || start.ending == ".obj" || start.ending == ".stl";
}

}  // namespace

ContourFormat scan_format() {
  return {.traits = {.name = "surface", .content = Content::surface, .noise = 1e-3},
          .about = "PLY, OBJ and STL scans",
          .known_by_bytes = known_by_bytes,
          .known_by_line = {},
          .read = read,
          .example = {.name = "scan.obj",
                      .text = "v 60 -10 95\nv 60 10 95\nv 90 -10 115\nv 90 10 115\n"
                              "f 1 2 3\nf 2 4 3\n",
                      .options = {}}};
}

}  // namespace genio
