#include "inverse/recording/curves/usc_pts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

constexpr size_t one_curve = 100;  // points of a tongue alone, at most
constexpr double next_organ = 8;   // a step so many usual ones long leads to another organ
constexpr double most_points = 1e6;

/// "A-B", counted from 1.
std::pair<size_t, size_t> range_of(const std::string& text, size_t count) {
  const auto dash = text.find('-');
  double a = 0, b = 0;
  if (dash == std::string::npos || !parse_number(text.substr(0, dash), a) ||
      !parse_number(text.substr(dash + 1), b) || a != std::floor(a) || b != std::floor(b) ||
      !(1 <= a && a < b && b <= double(count)))
    throw InputError(fmt::format("--points {}: expected A-B with 1 <= A < B <= {}", text, count));
  return {size_t(a) - 1, size_t(b)};
}

/// The number behind a title, as in "n_points:  20".
double value_of(const std::string& line, const std::string& title, const TableLines& lines) {
  double value = 0;
  if (!line.starts_with(title) || !parse_number(line.substr(title.size()), value))
    lines.fail(fmt::format("{}; expected '{} NUMBER'", in_quotes(line), title));
  return value;
}

std::vector<ContourPoint> points_of(TableLines& lines) {
  std::string line;
  const auto next = [&] {
    if (!lines.next_filled(line)) lines.fail("the file ends before its '}'");
    line = trimmed(line);
  };
  next();
  value_of(line, "version:", lines);
  next();
  const double count = value_of(line, "n_points:", lines);
  if (!(count > 0 && count <= most_points) || count != std::floor(count))
    lines.fail(fmt::format("n_points: {:g}; expected a number from 1 on", count));
  next();
  if (line != "{") lines.fail(fmt::format("{}; expected '{{'", in_quotes(line)));
  std::vector<ContourPoint> points;
  for (next(); line != "}"; next()) {
    const auto fields = split_at_blanks(line);
    double x = 0, y = 0;
    if (fields.size() != 2 || !parse_number(fields[0], x) || !parse_number(fields[1], y))
      lines.fail(fmt::format("{}; expected two numbers, x and y", in_quotes(line)));
    points.push_back({{x, not_given, y}, 0, "curve"});
  }
  if (double(points.size()) != count)
    lines.fail(fmt::format("{} points; n_points says {:g}", points.size(), count));
  if (lines.next_filled(line)) lines.fail("text after the '}'; expected one image a file");
  return points;
}

bool holds_several_curves(const std::vector<ContourPoint>& points) {
  std::vector<double> steps;
  for (size_t k = 1; k < points.size(); ++k) {
    const Vec3 step = points[k].position - points[k - 1].position;
    steps.push_back(std::hypot(step[0], step[2]));
  }
  if (steps.empty()) return false;
  std::sort(steps.begin(), steps.end());
  return steps.back() > next_organ * steps[steps.size() / 2];
}

RawContours read(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  auto points = points_of(lines);
  RawContours raw{{}, FileAxes{"px", "", "down"}};
  raw.file.model_frame = false;
  ContourFrame& frame = raw.file.frames.emplace_back();
  double number = 0;
  const std::string stem = std::filesystem::path(path).stem().string();
  frame.number =
      parse_number(stem, number) && number == std::floor(number) && number >= 1 && number < 1e9
          ? int(number)
          : 1;
  if (!o.points.empty()) {
    const auto [first, last] = range_of(o.points, points.size());
    raw.file.remarks.push_back(
        fmt::format("points {} of {} are the {}'s, as said", o.points, points.size(), o.role));
    points = {points.begin() + long(first), points.begin() + long(last)};
  } else if (points.size() > one_curve || holds_several_curves(points)) {
    throw InputError(fmt::format(
        "{}: {} landmarks, which are those of several organs; say which are the {}'s with --points "
        "A-B, counted from 1",
        path, points.size(), o.role));
  }
  frame.points = std::move(points);
  return raw;
}

bool known_by_line(const FileStart& start) {
  return start.line.starts_with("version:") && !start.more.empty() &&
         start.more[0].starts_with("n_points:");
}

}  // namespace

ContourFormat usc_pts_format() {
  ReadOptions pixels;
  pixels.mm_per_px = 2.9;
  return {.traits = {.name = "usc_pts", .noise = ultrasound_noise},
          .about = "landmarks of one image (.pts), as USC-TIMIT's",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "101.pts",
                      .text = "version: 1\nn_points: 3\n{\n40 35\n48 30\n56 33\n}\n",
                      .options = pixels}};
}

}  // namespace genio
