#include "forward/polygons/stl.hpp"

#include <fmt/format.h>

#include "forward/polygons/binary.hpp"
#include "forward/polygons/text_cursor.hpp"

namespace genio {
namespace {

constexpr size_t stl_header = 84, stl_triangle = 50;  // bytes

Polygons binary_stl(std::string_view bytes) {
  Polygons result;
  for (size_t at = stl_header; at < bytes.size(); at += stl_triangle) {
    for (size_t corner = 0; corner < 3; ++corner) {
      Vec3 x;  // behind the normal
      for (size_t i = 0; i < 3; ++i)
        x[Eigen::Index(i)] = binary_value<float>(bytes, at + 12 * (corner + 1) + 4 * i, false);
      result.corners.push_back(int(result.points.size()));
      result.points.push_back(x);
    }
    result.close_face();
  }
  return result;
}

Polygons ascii_stl(const std::string& path, std::string_view bytes) {
  TextCursor text(path, bytes);
  Polygons result;
  size_t first = 0;
  const auto close = [&] {
    if (result.points.size() != first && result.points.size() != first + 3)
      text.fail(fmt::format("a facet of {} vertices; expected 3", result.points.size() - first));
    if (result.points.size() != first) result.close_face();
    first = result.points.size();
  };
  while (text.next_line())
    for (std::string_view word; text.next_word(word);) {
      if (word == "vertex") {
        Vec3 x;
        for (int i = 0; i < 3; ++i) x[i] = text.next_number("a coordinate");
        result.corners.push_back(int(result.points.size()));
        result.points.push_back(x);
      } else if (word == "normal") {
        for (int i = 0; i < 3; ++i) text.next_word(word);
      } else if (word == "facet" || word == "endfacet") {
        close();
      } else if (word == "solid" || word == "endsolid") {
        close();
        break;  // its name may be any text
      } else if (word != "outer" && word != "loop" && word != "endloop") {
        text.fail(fmt::format("{} is no word of an STL file", shown(word)));
      }
    }
  close();
  return result;
}

}  // namespace

Polygons read_stl(const std::string& path, std::string_view bytes) {
  const size_t claimed = bytes.size() < stl_header ? 0 : binary_value<uint32_t>(bytes, 80, false);
  if (bytes.size() >= stl_header && bytes.size() - stl_header == claimed * stl_triangle)
    return binary_stl(bytes);
  const size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start != bytes.npos && bytes.substr(start).starts_with("solid") &&
      bytes.find('\0') == bytes.npos)
    return ascii_stl(path, bytes);
  throw InputError(fmt::format(
      "{}: is no STL file: it does not start with 'solid', and of {} bytes it names {} triangles, "
      "which take {}",
      path, bytes.size(), claimed, stl_header + claimed * stl_triangle));
}

}  // namespace genio
