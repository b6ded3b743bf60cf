#include "inverse/recording/curves/aaa_polar.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

constexpr const char* count_title = "Number of points of spline";

/// Columns of a row whose spline begins at field `first` with its number of points N: then N radii
/// and N angles. The header has one title a block.
struct PolarLayout {
  size_t first = 0, label = 0, time = 0;
  bool has_label = false, has_time = false;
};

PolarLayout polar_layout(const std::vector<std::string>& titles, const TableLines& lines) {
  PolarLayout l;
  bool found = false;
  for (size_t c = 0; c < titles.size() && !found; ++c) {
    const std::string t = trimmed(titles[c]);
    if (t == "Prompt") l.label = c, l.has_label = true;
    if (t == "Time of sample in recording") l.time = c, l.has_time = true;
    if (t.starts_with(count_title)) l.first = c, found = true;
  }
  if (!found) lines.fail(fmt::format("the header has no '{} ...'", count_title));
  return l;
}

}  // namespace

RawContours read_aaa_polar(const std::string& path) {
  TableLines lines(path);
  RawContours raw{{}, FileAxes{"mm", "right", "up"}};
  raw.file.model_frame = false;
  std::string line;
  if (!lines.next(line)) lines.fail("the file is empty");
  const PolarLayout l = polar_layout(split_fields(line, '\t'), lines);
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const auto fields = split_fields(line, '\t');
    double count = 0;
    if (l.first >= fields.size() || !parse_number(fields[l.first], count) ||
        count != std::floor(count) || count < 0 || count > 10000)
      lines.fail(fmt::format("field {}: expected the number of points of the spline", l.first + 1));
    const auto n = size_t(count);
    if (fields.size() < l.first + 1 + 2 * n)
      lines.fail(
          fmt::format("{} fields; {} points need {}", fields.size(), n, l.first + 1 + 2 * n));
    ContourFrame frame;
    frame.number = int(raw.file.frames.size()) + 1;
    if (l.has_label) frame.label = trimmed(fields[l.label]);
    if (l.has_time) parse_number(fields[l.time], frame.time_s);
    for (size_t k = 0; k < n; ++k) {
      const std::string radius = trimmed(fields[l.first + 1 + k]),
                        angle = trimmed(fields[l.first + 1 + n + k]);
      if (radius.empty() || radius == "*") continue;
      double r = 0, a = 0;
      if (!parse_number(radius, r) || !parse_number(angle, a))
        lines.fail(fmt::format("knot {}: '{}', '{}'; expected a radius and an angle, or '*'", k,
                               radius, angle));
      if (std::abs(a) > 2 * std::numbers::pi)
        lines.fail(fmt::format("knot {}: angle {}; expected radians", k, a));
      frame.points.push_back({{r * std::sin(a), not_given, r * std::cos(a)}, 0, "curve"});
    }
    if (frame.points.empty()) frame.note = "the frame is empty (no knot has a value)";
    raw.file.frames.push_back(std::move(frame));
  }
  if (raw.file.frames.empty()) lines.fail("the file has no data row");
  return raw;
}

bool has_polar_blocks(const std::string& path) {
  TableLines lines(path);
  std::string first;
  return lines.next(first) && first.find(count_title) != std::string::npos;
}

}  // namespace genio
