#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace genio {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary file.
size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type, count_type;  ///< the second of a list's number of values
  bool is_list = false;
};

struct PlyElement {
  std::string name;
  size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Form { ascii, little_endian, big_endian } form = Form::ascii;
  std::vector<PlyElement> elements;
  size_t size = 0;  ///< bytes up to the first element
  int lines = 0;
};

/// Throws InputError naming `path` and line; also where the elements that the header claims need
/// more bytes than there are.
PlyHeader read_ply_header(const std::string& path, std::string_view bytes);

}  // namespace genio
