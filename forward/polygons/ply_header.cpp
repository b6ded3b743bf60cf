#include "forward/polygons/ply_header.hpp"

#include <fmt/format.h>

#include <charconv>
#include <map>

#include "forward/base/types.hpp"
#include "forward/polygons/text_cursor.hpp"

namespace genio {
namespace {

PlyType ply_type(const TextCursor& text, std::string_view word) {
  static const std::map<std::string_view, PlyType> types = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const auto it = types.find(word);
  if (it == types.end())
    text.fail(fmt::format("{}; expected a type, such as float or uchar", shown(word)));
  return it->second;
}

std::string_view ply_word(TextCursor& text, const char* what) {
  std::string_view word;
  if (!text.next_word(word)) text.fail(fmt::format("the line ends; expected {}", what));
  return word;
}

PlyHeader::Form ply_form(TextCursor& text) {
  const std::string_view form = ply_word(text, "the form of the file");
  if (form == "ascii") return PlyHeader::Form::ascii;
  if (form == "binary_little_endian") return PlyHeader::Form::little_endian;
  if (form == "binary_big_endian") return PlyHeader::Form::big_endian;
  text.fail(
      fmt::format("{}; expected ascii, binary_little_endian or binary_big_endian", shown(form)));
}

PlyElement ply_element(TextCursor& text) {
  PlyElement element;
  element.name = ply_word(text, "the name of an element");
  const std::string_view count = ply_word(text, "the number of elements");
  const auto [end, error] =
      std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (error != std::errc() || end != count.data() + count.size())
    text.fail(fmt::format("{}; expected a number of elements", shown(count)));
  return element;
}

PlyProperty ply_property(TextCursor& text) {
  PlyProperty property;
  std::string_view word = ply_word(text, "the type of a property");
  if (word == "list") {
    property.is_list = true;
    property.count_type = ply_type(text, ply_word(text, "the type of a list's length"));
    if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
      text.fail("the length of a list must be a whole number");
    word = ply_word(text, "the type of a list");
  }
  property.type = ply_type(text, word);
  property.name = ply_word(text, "the name of a property");
  return property;
}

/// Each element takes at least so many bytes.
size_t least_bytes(const PlyElement& element, PlyHeader::Form form) {
  size_t bytes = 0;
  for (const PlyProperty& p : element.properties)
    bytes += form == PlyHeader::Form::ascii ? 2 : size_of(p.is_list ? p.count_type : p.type);
  return bytes;
}

void check_claims(const std::string& path, const PlyHeader& header, size_t file_size) {
  size_t left = file_size - header.size + 1;  // the last line may have no end
  for (const PlyElement& element : header.elements) {
    const size_t each = least_bytes(element, header.form);
    if (each == 0) continue;
    if (element.count > left / each)
      throw InputError(fmt::format(
          "{}: the header names {} elements '{}', which take at least {} bytes each; {} are left",
          path, element.count, element.name, each, left - 1));
    left -= element.count * each;
  }
}

}  // namespace

size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    default:
      return 4;
  }
}

PlyHeader read_ply_header(const std::string& path, std::string_view bytes) {
  TextCursor text(path, bytes);
  PlyHeader header;
  std::string_view word;
  if (!text.next_line() || !text.next_word(word) || word != "ply")
    text.fail("is no PLY file; expected 'ply' in its first line");
  bool has_form = false;
  for (header.lines = 1;;) {
    if (!text.next_line()) text.fail("the header has no 'end_header'");
    ++header.lines;
    if (!text.next_word(word) || word == "comment" || word == "obj_info") continue;
    if (word == "end_header") break;
    if (word == "format") {
      header.form = ply_form(text);
      has_form = true;
    } else if (word == "element") {
      header.elements.push_back(ply_element(text));
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(ply_property(text));
    } else {
      text.fail(fmt::format("{}; expected format, element, property or end_header", shown(word)));
    }
  }
  if (!has_form) text.fail("the header has no line 'format'");
  header.size = std::min(text.offset(), bytes.size());
  check_claims(path, header, bytes.size());
  return header;
}

}  // namespace genio
