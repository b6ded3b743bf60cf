#include "inverse/recording/contour_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "inverse/recording/base/confidence.hpp"
#include "inverse/recording/format_list.hpp"

namespace genio {
namespace {

const ContourFormat& format_for(const std::string& path, const ReadOptions& o) {
  if (o.format != "auto") return format_named(o.format);
  return o.columns.empty() ? format_of(path, o) : format_named("columns");
}

/// Throws InputError where an option is given that files of the format have no use for.
void check_options(const std::string& path, const std::string& format, const ReadOptions& o) {
  const auto check = [&](bool given, const char* option, const std::vector<std::string>& formats) {
    if (given && std::find(formats.begin(), formats.end(), format) == formats.end())
      throw InputError(fmt::format("{}: {} is for files of format {}; this one is {}", path, option,
                                   fmt::join(formats, " or "), format));
  };
  check(!o.columns.empty(), "--columns", {"columns"});
  std::vector<std::string> of_splines = {"aaa", "deeplabcut"};
  if (o.role != "tongue") of_splines.emplace_back("mview");
  check(!o.spline.empty(), "--spline", of_splines);
  check(!o.points.empty(), "--points", {"usc_pts"});
}

}  // namespace

RawContours read_raw(const std::string& path, const ReadOptions& options) {
  const ContourFormat& format = format_for(path, options);
  check_options(path, format.traits.name, options);
  RawContours raw = format.read(path, options);
  raw.file.format = format.traits;
  remark_widened(raw.file);
  return raw;
}

ContourFile read_contours(const std::string& path, const ReadOptions& options) {
  RawContours raw = read_raw(path, options);
  if (!raw.axes) return std::move(raw.file);
  return in_model_axes(std::move(raw.file), *raw.axes, path, options);
}

}  // namespace genio
