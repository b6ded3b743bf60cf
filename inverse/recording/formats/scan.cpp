#include <fmt/format.h>

#include "forward/geometry/triangle_surface.hpp"
#include "inverse/recording/formats/contour_formats.hpp"

namespace genio {
namespace {

constexpr size_t enough = 400;  // points of a scan

}  // namespace

/// The vertices of a surface, at most some hundreds of them evenly through the file: neighbours
/// say nearly the same.
RawContours read_scan(const std::string& path) {
  const TriangleSurface scan = read_surface(path);
  RawContours raw{{}, {"", "left", "up"}};
  raw.file.format = ContourFormat::surface;
  ContourFrame& frame = raw.file.frames.emplace_back();
  frame.number = 1;
  const size_t stride = (scan.vertices.size() + enough - 1) / enough;
  for (size_t k = 0; k < scan.vertices.size(); k += stride)
    frame.points.push_back({scan.vertices[k], 0, "surface"});
  raw.file.remarks.push_back(
      fmt::format("{} of {} vertices of the scan, taken as points of the "
                  "tongue's surface in the model's frame",
                  frame.points.size(), scan.vertices.size()));
  return raw;
}

}  // namespace genio
