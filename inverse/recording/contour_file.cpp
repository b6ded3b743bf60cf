#include "inverse/recording/contour_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "inverse/recording/formats/contour_formats.hpp"
#include "inverse/recording/table_text.hpp"

namespace genio {
namespace {

std::string ending(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

std::string first_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": no such file");
  std::string bytes(4, '\0');
  in.read(bytes.data(), 4);
  return bytes.substr(0, size_t(in.gcount()));
}

/// The format by content and ending.
std::string detected(const std::string& path) {
  const std::string magic = first_bytes(path), end = ending(path);
  if (magic == "SSFF" || magic == "AG50" || end == ".pos") return "ema";
  if (end == ".ply" || end == ".obj" || end == ".stl") return "surface";
  TableLines lines(path);
  std::string first;
  while (lines.next(first) && trimmed(first).empty()) {
  }
  if (first.find("Ch1_X") != std::string::npos) return "ema";
  if (first.starts_with("FRAME\tTIME")) return "getcontours";
  if (first.starts_with("FRAME") || end == ".con") return "edgetrak";
  if (first.find('\t') != std::string::npos) return "aaa";
  if (first.find("frame") != std::string::npos && first.find(',') != std::string::npos)
    return "csv";
  if (first.find(',') != std::string::npos) {
    double x = 0;
    return parse_number(split_fields(first, ',').front(), x) ? "edgetrak" : "csv";
  }
  throw InputError(fmt::format(
      "{}:{}: neither tab-separated (AAA, GetContours) nor comma-separated (CSV), nor a file of "
      "points known by its first bytes or ending; give --format",
      path, std::max(1, lines.number())));
}

bool has_polar_blocks(const std::string& path) {
  TableLines lines(path);
  std::string first;
  return lines.next(first) && first.find("Number of points of spline") != std::string::npos;
}

}  // namespace

const char* to_string(ContourFormat format) {
  constexpr const char* names[] = {"csv", "aaa", "getcontours", "edgetrak", "ema", "surface"};
  return names[int(format)];
}

ContourFile read_contours(const std::string& path, const ReadOptions& o) {
  const std::string format = o.format == "auto" ? detected(path) : o.format;
  const auto converted = [&](RawContours raw) { return in_model_axes(std::move(raw), path, o); };
  if (format == "csv") return read_csv_contours(path);
  if (format == "aaa")
    return converted(has_polar_blocks(path) ? read_aaa_polar(path) : read_aaa_contours(path));
  if (format == "getcontours") return converted(read_getcontours(path));
  if (format == "edgetrak") return converted(read_edgetrak(path));
  if (format == "ema")
    return converted(first_bytes(path) == "SSFF" ? read_ssff(path, o) : read_ema(path, o));
  if (format == "surface") return converted(read_scan(path));
  throw InputError(fmt::format(
      "--format {}: unknown; expected auto, csv, aaa, getcontours, edgetrak, ema or surface",
      o.format));
}

}  // namespace genio
