#include "inverse/recording/curves/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/base/nearest_name.hpp"
#include "inverse/recording/base/frame_rows.hpp"

namespace genio {
namespace {

const std::vector<std::string> known_columns = {
    "frame",  "point",     "x_mm",      "y_mm",      "z_mm",  "sigma_mm",  "kind",   "label",
    "time_s", "rest_x_mm", "rest_y_mm", "rest_z_mm", "slice", "recording", "speaker"};

/// Where each column stands.
using Columns = std::map<std::string, size_t>;

Columns columns_of(const std::vector<std::string>& header, const TableLines& lines) {
  Columns column;
  for (size_t c = 0; c < header.size(); ++c) {
    const std::string name = trimmed(header[c]);
    if (std::find(known_columns.begin(), known_columns.end(), name) == known_columns.end())
      lines.fail(fmt::format(
          "unknown column {}; did you mean {}? Of a table with other titles say which column is "
          "which: --columns frame={},x=...,y=...",
          in_quotes(name), nearest_name(name, known_columns), trimmed(header[0])));
    if (!column.emplace(name, c).second)
      lines.fail(fmt::format("column {} stands twice", in_quotes(name)));
  }
  for (const char* needed : {"frame", "x_mm", "z_mm"})
    if (!column.contains(needed)) lines.fail(fmt::format("column '{}' is missing", needed));
  return column;
}

/// The fields of one line by their columns' names.
struct Row {
  const Columns& column;
  const TableLines& lines;
  TableNumbers& numbers;
  std::vector<std::string> fields;

  bool has(const std::string& name) const { return column.contains(name); }
  /// Empty where there is no such column.
  std::string text(const std::string& name) const {
    return has(name) ? trimmed(fields[column.at(name)]) : "";
  }
  double number(const std::string& name) const {
    double v = 0;
    if (!numbers.parse(fields[column.at(name)], v))
      lines.fail(fmt::format("field {}: {}", name, numbers.complaint(fields[column.at(name)])));
    return v;
  }
  int whole(const std::string& name, double most) const {
    const double v = number(name);
    if (v != std::floor(v) || std::abs(v) > most)
      lines.fail(fmt::format("field {}: {} is not a whole number", name, v));
    return int(v);
  }
};

ContourPoint point_of(const Row& row) {
  ContourPoint p;
  const bool has_y = !row.text("y_mm").empty();
  p.position = 1e-3 * Vec3(row.number("x_mm"), has_y ? row.number("y_mm") : 0, row.number("z_mm"));
  if (!has_y) p.position[1] = std::numeric_limits<double>::quiet_NaN();
  if (!row.text("sigma_mm").empty()) {
    p.sigma = 1e-3 * row.number("sigma_mm");
    if (!(p.sigma > 0)) row.lines.fail("field sigma_mm: must be above 0");
  }
  p.kind = row.text("kind");
  if (p.kind.empty()) p.kind = "curve";
  if (p.kind == "surface" && !has_y) row.lines.fail("a surface point needs y_mm");
  if (p.kind == "volume") {
    for (const char* needed : {"rest_x_mm", "rest_y_mm", "rest_z_mm"})
      if (!row.has(needed)) row.lines.fail(fmt::format("a volume point needs column '{}'", needed));
    p.rest = 1e-3 * Vec3(row.number("rest_x_mm"), row.number("rest_y_mm"), row.number("rest_z_mm"));
  }
  if (row.has("slice")) p.slice = row.whole("slice", 1e6);
  return p;
}

/// A frame's points are told apart by their numbers, flesh points by their names, or rows of a
/// frame stand together.
void count(FrameRows& frames, const Row& row, const ContourPoint& point) {
  const bool listed = point.kind == "curve" || point.kind == "surface" || point.kind == "volume";
  if (!row.text("point").empty())
    frames.count(fmt::format("{} {}", point.kind, point.slice), row.number("point"));
  else if (listed) frames.expect_together();
  else frames.count(point.kind, 1);
}

RawContours read(const std::string& path, const ReadOptions&) {
  TableLines lines(path);
  std::string line = lines.first_filled();
  const char separator = separator_of(line);
  const auto header = fields_of(line, separator);
  const Columns column = columns_of(header, lines);
  TableNumbers numbers(separator);
  FrameRows frames(lines);
  while (lines.next_filled(line)) {
    const Row row{column, lines, numbers, fields_of(line, separator)};
    if (row.fields.size() != header.size())
      lines.fail(other_count(row.fields.size(), "header", header.size(), line));
    RowFrame of{
        row.whole("frame", 1e9), row.text("recording"), row.text("speaker"), row.text("label"), {}};
    if (!row.text("time_s").empty()) of.time_s = row.number("time_s");
    ContourFrame& frame = frames.frame(of);
    frame.points.push_back(point_of(row));
    count(frames, row, frame.points.back());
  }
  RawContours raw;
  raw.file.frames = frames.take();
  if (numbers.has_commas()) raw.file.remarks.push_back("numbers have decimal commas");
  return raw;
}

/// The columns that it cannot be without, by any separator.
bool known_by_line(const FileStart& start) {
  bool frame = false, x = false, z = false;
  for (const std::string& field : fields_of(start.line, separator_of(start.line)))
    frame = frame || trimmed(field) == "frame", x = x || trimmed(field) == "x_mm",
    z = z || trimmed(field) == "z_mm";
  return (frame && x && z) || start.line.find(',') != std::string::npos;
}

}  // namespace

ContourFormat csv_format() {
  return {.traits = {.name = "csv"},
          .about = "the table of the README, in the model's frame",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "shape.csv",
                      .text = "frame,point,x_mm,z_mm\n1,1,60,95\n1,2,90,115\n",
                      .options = {}}};
}

}  // namespace genio
