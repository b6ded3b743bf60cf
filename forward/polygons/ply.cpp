#include "forward/polygons/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "forward/polygons/binary.hpp"
#include "forward/polygons/ply_header.hpp"
#include "forward/polygons/text_cursor.hpp"

namespace genio {
namespace {

/// The values behind the header, one after another.
class PlyBody {
 public:
  PlyBody(const std::string& path, std::string_view bytes, const PlyHeader& header)
      : path_(path),
        bytes_(bytes.substr(header.size)),
        form_(header.form),
        text_(path, bytes_, header.lines) {}

  /// In ASCII an element is a line.
  void start_element(const std::string& name, size_t number) {
    name_ = name, number_ = number;
    if (form_ != PlyHeader::Form::ascii) return;
    do
      if (!text_.next_line()) fail("the file ends");
    while (text_.rest().find_first_not_of(" \t") == std::string_view::npos);
  }
  void end_element() {
    std::string_view word;
    if (form_ == PlyHeader::Form::ascii && text_.next_word(word))
      fail(fmt::format("{} behind the last property", shown(word)));
  }
  double value(PlyType type) {
    if (form_ == PlyHeader::Form::ascii) return text_.next_number("a number");
    if (bytes_.size() - at_ < size_of(type)) fail("the file ends");
    const bool big = form_ == PlyHeader::Form::big_endian;
    const size_t at = std::exchange(at_, at_ + size_of(type));
    switch (type) {
      case PlyType::int8:
        return binary_value<int8_t>(bytes_, at, big);
      case PlyType::uint8:
        return binary_value<uint8_t>(bytes_, at, big);
      case PlyType::int16:
        return binary_value<int16_t>(bytes_, at, big);
      case PlyType::uint16:
        return binary_value<uint16_t>(bytes_, at, big);
      case PlyType::int32:
        return binary_value<int32_t>(bytes_, at, big);
      case PlyType::uint32:
        return binary_value<uint32_t>(bytes_, at, big);
      case PlyType::float32:
        return binary_value<float>(bytes_, at, big);
      default:
        return binary_value<double>(bytes_, at, big);
    }
  }
  /// How many values a list has; no more than there are bytes.
  size_t list_length(const PlyProperty& property) {
    const double length = value(property.count_type);
    if (!(length >= 0 && length <= double(bytes_.size())) || length != std::floor(length))
      fail(fmt::format("a list of {} values", length));
    return size_t(length);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {} {}: {}", path_, name_, number_ + 1, what));
  }

 private:
  std::string path_, name_;
  std::string_view bytes_;
  PlyHeader::Form form_;
  TextCursor text_;
  size_t at_ = 0, number_ = 0;
};

void skip(PlyBody& body, const PlyProperty& property) {
  for (size_t n = property.is_list ? body.list_length(property) : 1; n > 0; --n)
    body.value(property.type);
}

Vec3 ply_point(PlyBody& body, const PlyElement& element) {
  Vec3 x;
  for (const PlyProperty& p : element.properties) {
    const bool coordinate = !p.is_list && p.name.size() == 1 && p.name >= "x" && p.name <= "z";
    if (coordinate) x[p.name[0] - 'x'] = double(float(body.value(p.type)));
    else skip(body, p);
  }
  return x;
}

/// The point numbers of a face; negative ones part the strips of a list of strips.
std::vector<int> ply_corners(PlyBody& body, const PlyElement& element, size_t points) {
  std::vector<int> corners;
  for (const PlyProperty& p : element.properties) {
    if (!p.is_list || (p.name != "vertex_indices" && p.name != "vertex_index")) {
      skip(body, p);
      continue;
    }
    for (size_t n = body.list_length(p); n > 0; --n) {
      const double corner = body.value(p.type);
      const bool parts = element.name == "tristrips" && corner < 0;
      if (!parts && !(corner >= 0 && corner < double(points) && corner == std::floor(corner)))
        body.fail(fmt::format("names point {}; expected 0 to {}", corner, double(points) - 1));
      corners.push_back(parts ? -1 : int(corner));
    }
  }
  return corners;
}

/// Each three neighbours of a strip are a triangle, every second one turned.
void add_strips(Polygons& polygons, const std::vector<int>& strips) {
  size_t first = 0;
  for (size_t k = 0; k < strips.size(); ++k) {
    if (strips[k] < 0) first = k + 1;
    if (strips[k] < 0 || k < first + 2) continue;
    const bool turned = (k - first) % 2 != 0;
    for (const size_t back : {2, turned ? 0 : 1, turned ? 1 : 0})
      polygons.corners.push_back(strips[k - back]);
    polygons.close_face();
  }
}

void check_vertex(const std::string& path, const PlyElement& vertex) {
  for (const char* name : {"x", "y", "z"}) {
    const auto has = std::count_if(vertex.properties.begin(), vertex.properties.end(),
                                   [&](const auto& p) { return p.name == name && !p.is_list; });
    if (has != 1)
      throw InputError(
          fmt::format("{}: its vertices have {} properties '{}'; expected one", path, has, name));
  }
}

}  // namespace

Polygons read_ply(const std::string& path, std::string_view bytes) {
  const PlyHeader header = read_ply_header(path, bytes);
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const PlyElement& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end())
    throw InputError(path + ": the header has no element 'vertex'");
  check_vertex(path, *vertex);
  PlyBody body(path, bytes, header);
  Polygons result;
  result.in_order = true;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    const bool strips = element.name == "tristrips", faces = strips || element.name == "face";
    for (size_t k = 0; k < element.count; ++k) {
      body.start_element(element.name, k);
      if (&element == &*vertex) {
        result.points.push_back(ply_point(body, element));
      } else if (faces) {
        const auto corners = ply_corners(body, element, vertex->count);
        if (strips) add_strips(result, corners);
        else if (corners.size() > 2) {
          result.corners.insert(result.corners.end(), corners.begin(), corners.end());
          result.close_face();
        }
      } else {
        for (const PlyProperty& p : element.properties) skip(body, p);
      }
      body.end_element();
    }
  }
  return result;
}

}  // namespace genio
