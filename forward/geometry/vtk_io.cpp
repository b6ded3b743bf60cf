#include "forward/geometry/vtk_io.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <pugixml.hpp>
#include <sstream>

#include "forward/base/input_file.hpp"
#include "forward/base/printed_text.hpp"
#include "forward/base/text_file.hpp"

namespace genio {
namespace {

std::vector<uint8_t> decode_base64(std::string_view text) {
  std::vector<uint8_t> bytes;
  uint32_t bits = 0;
  int held = 0;
  for (char c : text) {
    int v;
    if (c >= 'A' && c <= 'Z') v = c - 'A';
    else if (c >= 'a' && c <= 'z') v = c - 'a' + 26;
    else if (c >= '0' && c <= '9') v = c - '0' + 52;
    else if (c == '+') v = 62;
    else if (c == '/') v = 63;
    else if (c == '=') {
      held = 0, bits = 0;
      continue;
    }  // a header block ends with padding
    else
      continue;
    bits = bits << 6 | uint32_t(v);
    if ((held += 6) >= 8) bytes.push_back(uint8_t(bits >> (held -= 8)));
  }
  return bytes;
}

template <class T>
void unpack(const std::vector<uint8_t>& bytes, size_t offset, std::vector<double>& out) {
  for (size_t i = offset; i + sizeof(T) <= bytes.size(); i += sizeof(T)) {
    T v;
    std::memcpy(&v, &bytes[i], sizeof v);
    out.push_back(double(v));
  }
}

VtkArray read_array(const std::string& path, const pugi::xml_node& node, bool wide_header) {
  VtkArray a;
  const std::string name = node.attribute("Name").as_string(),
                    type = node.attribute("type").as_string();
  const std::string format = node.attribute("format").as_string("ascii");
  a.components = node.attribute("NumberOfComponents").as_int(1);
  a.integer = type.find("Int") != std::string::npos;
  if (a.components < 1)
    throw InputError(fmt::format("{}: array '{}' has {} components", path, name, a.components));
  if (format == "ascii") {
    std::istringstream in(node.text().get());
    for (std::string token; in >> token;) {
      char* end = nullptr;
      a.values.push_back(std::strtod(token.c_str(), &end));
      if (*end)
        throw InputError(
            fmt::format("{}: array '{}' holds '{}'; expected a number", path, name, token));
    }
  } else if (format == "binary") {
    const auto bytes = decode_base64(node.text().get());
    const size_t header = wide_header ? 8 : 4;
    if (type == "Float64") unpack<double>(bytes, header, a.values);
    else if (type == "Float32") unpack<float>(bytes, header, a.values);
    else if (type == "Int64") unpack<int64_t>(bytes, header, a.values);
    else if (type == "Int32") unpack<int32_t>(bytes, header, a.values);
    else if (type == "UInt8") unpack<uint8_t>(bytes, header, a.values);
    else throw InputError(fmt::format("{}: array '{}' has type {}", path, name, type));
  } else {
    throw InputError(fmt::format(
        "{}: array '{}' is stored as '{}'; expected ascii or inline binary (in ParaView: save with "
        "data mode Ascii)",
        path, name, format));
  }
  return a;
}

/// 0, which is no type, for what none can be.
int cell_type(double value) { return value >= 0 && value < 256 ? int(value) : 0; }

void read_cells(const std::string& path, const pugi::xml_node& node, bool wide, VtkData& data,
                int fixed_type) {
  VtkArray connectivity, offsets, types;
  for (const auto& array : node.children("DataArray")) {
    const std::string name = array.attribute("Name").as_string();
    if (name == "connectivity") connectivity = read_array(path, array, wide);
    if (name == "offsets") offsets = read_array(path, array, wide);
    if (name == "types") types = read_array(path, array, wide);
  }
  size_t at = 0;
  for (size_t c = 0; c < offsets.values.size(); ++c) {
    const double end = offsets.values[c];
    if (!(end >= double(at)) || end > double(connectivity.values.size()))
      throw InputError(fmt::format("{}: cell {} ends at offset {} of {} point numbers", path, c,
                                   end, connectivity.values.size()));
    std::vector<int> cell;
    for (; at < size_t(end); ++at) {
      const double point = connectivity.values[at];
      if (!(point >= 0) || point >= double(data.points.size()))
        throw InputError(fmt::format("{}: cell {} names point {}; the file has {} points", path, c,
                                     point, data.points.size()));
      cell.push_back(int(point));
    }
    data.cells.push_back(std::move(cell));
    data.types.push_back(fixed_type                ? fixed_type
                         : c < types.values.size() ? cell_type(types.values[c])
                                                   : 0);
  }
}

void print_array(PrintedText& out, const std::string& name, const VtkArray& a) {
  out.print("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
            a.integer ? "Int64" : "Float64", name, a.components);
  for (size_t i = 0; i < a.values.size(); ++i) {
    const char end = (i + 1) % size_t(a.components) == 0 ? '\n' : ' ';
    if (a.integer) out.print("{}{}", int64_t(a.values[i]), end);
    else out.print("{:.9g}{}", a.values[i], end);
  }
  out.print("</DataArray>\n");
}

VtkArray points_array(const VtkData& data) {
  VtkArray a{3, {}, false};
  for (const Vec3& p : data.points) a.values.insert(a.values.end(), {p[0], p[1], p[2]});
  return a;
}

void print_cells(PrintedText& out, const VtkData& data, bool with_types) {
  VtkArray connectivity{1, {}, true}, offsets{1, {}, true}, types{1, {}, true};
  for (size_t c = 0; c < data.cells.size(); ++c) {
    for (int i : data.cells[c]) connectivity.values.push_back(i);
    offsets.values.push_back(double(connectivity.values.size()));
    if (with_types) types.values.push_back(data.types[c]);
  }
  print_array(out, "connectivity", connectivity);
  print_array(out, "offsets", offsets);
  if (with_types) print_array(out, "types", types);
}

void print_data(PrintedText& out, const VtkData& data) {
  out.print("<PointData>\n");
  for (const auto& [name, array] : data.point_data) print_array(out, name, array);
  out.print("</PointData>\n<CellData>\n");
  for (const auto& [name, array] : data.cell_data) print_array(out, name, array);
  out.print("</CellData>\n");
}

}  // namespace

VtkData read_vtk(const std::string& path) {
  const std::string bytes = read_file(path);
  pugi::xml_document doc;
  const auto parsed = doc.load_buffer(bytes.data(), bytes.size());
  if (!parsed)
    throw InputError(fmt::format("{}: not a VTK XML file ({} at byte {})", path,
                                 parsed.description(), parsed.offset));
  const auto root = doc.child("VTKFile");
  const std::string type = root.attribute("type").as_string();
  const auto piece = root.child(type.c_str()).child("Piece");
  if (!piece || (type != "UnstructuredGrid" && type != "PolyData"))
    throw InputError(path + ": expected a VTK XML UnstructuredGrid or PolyData with one piece");
  if (!std::string(root.attribute("compressor").as_string()).empty())
    throw InputError(path + ": compressed VTK arrays are not read; save without compression");
  const bool wide = std::string(root.attribute("header_type").as_string()) == "UInt64";
  VtkData data;
  const auto points = read_array(path, piece.child("Points").child("DataArray"), wide);
  if (points.components != 3 || points.values.size() % 3)
    throw InputError(path + ": points need 3 coordinates each");
  for (size_t i = 0; i < points.values.size(); i += 3)
    data.points.emplace_back(points.values[i], points.values[i + 1], points.values[i + 2]);
  if (type == "UnstructuredGrid") read_cells(path, piece.child("Cells"), wide, data, 0);
  else read_cells(path, piece.child("Lines"), wide, data, 4);
  const auto read_data = [&](const char* where, std::map<std::string, VtkArray>& into, size_t n) {
    for (const auto& node : piece.child(where).children("DataArray")) {
      const std::string name = node.attribute("Name").as_string();
      auto array = read_array(path, node, wide);
      if (array.values.size() != n * size_t(array.components))
        throw InputError(fmt::format("{}: array '{}' has {} values; expected {}", path, name,
                                     array.values.size(), n * size_t(array.components)));
      into[name] = std::move(array);
    }
  };
  read_data("PointData", data.point_data, data.points.size());
  read_data("CellData", data.cell_data, data.cells.size());
  return data;
}

void write_vtu(const std::string& path, const VtkData& data) {
  PrintedText out;
  out.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
      data.points.size(), data.cells.size());
  print_array(out, "Points", points_array(data));
  out.print("</Points>\n<Cells>\n");
  print_cells(out, data, true);
  out.print("</Cells>\n");
  print_data(out, data);
  out.print("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  write_text(path, out.text);
}

void write_vtp_lines(const std::string& path, const VtkData& data) {
  PrintedText out;
  out.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" "
      "NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n<Points>\n",
      data.points.size(), data.cells.size());
  print_array(out, "Points", points_array(data));
  out.print("</Points>\n<Lines>\n");
  print_cells(out, data, false);
  out.print("</Lines>\n");
  print_data(out, data);
  out.print("</Piece>\n</PolyData>\n</VTKFile>\n");
  write_text(path, out.text);
}

}  // namespace genio
