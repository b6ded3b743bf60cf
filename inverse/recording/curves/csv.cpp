#include "inverse/recording/curves/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "forward/base/nearest_name.hpp"
#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

const std::vector<std::string> known_columns = {
    "frame", "point",  "x_mm",      "y_mm",      "z_mm",      "sigma_mm", "kind",
    "label", "time_s", "rest_x_mm", "rest_y_mm", "rest_z_mm", "slice"};

/// Where each column stands.
using Columns = std::map<std::string, size_t>;

Columns columns_of(const std::vector<std::string>& header, const TableLines& lines) {
  Columns column;
  for (size_t c = 0; c < header.size(); ++c) {
    const std::string name = trimmed(header[c]);
    if (std::find(known_columns.begin(), known_columns.end(), name) == known_columns.end())
      lines.fail(fmt::format("unknown column '{}'; did you mean {}?", name,
                             nearest_name(name, known_columns)));
    if (!column.emplace(name, c).second) lines.fail(fmt::format("column '{}' stands twice", name));
  }
  for (const char* needed : {"frame", "x_mm", "z_mm"})
    if (!column.contains(needed)) lines.fail(fmt::format("column '{}' is missing", needed));
  return column;
}

/// The fields of one line by their columns' names.
struct Row {
  const Columns& column;
  const TableLines& lines;
  std::vector<std::string> fields;

  bool has(const std::string& name) const { return column.contains(name); }
  /// Empty where there is no such column.
  std::string text(const std::string& name) const {
    return has(name) ? trimmed(fields[column.at(name)]) : "";
  }
  double number(const std::string& name) const {
    double v = 0;
    if (!parse_number(fields[column.at(name)], v))
      lines.fail(
          fmt::format("field {}: '{}' is not a finite number", name, fields[column.at(name)]));
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

RawContours read(const std::string& path, const ReadOptions&) {
  TableLines lines(path);
  std::string line;
  if (!lines.next(line)) lines.fail("the file is empty; expected a header line");
  const auto header = split_fields(line, ',');
  const Columns column = columns_of(header, lines);
  ContourFile file;
  std::map<int, size_t> index;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const Row row{column, lines, split_fields(line, ',')};
    if (row.fields.size() != header.size())
      lines.fail(fmt::format("{} fields; the header has {}", row.fields.size(), header.size()));
    const int number = row.whole("frame", 1e9);
    const auto [it, fresh] = index.try_emplace(number, file.frames.size());
    if (fresh) file.frames.emplace_back().number = number;
    ContourFrame& frame = file.frames[it->second];
    ContourPoint point = point_of(row);
    if (frame.label.empty()) frame.label = row.text("label");
    if (!row.text("time_s").empty()) frame.time_s = row.number("time_s");
    frame.points.push_back(std::move(point));
  }
  if (file.frames.empty()) lines.fail("the file has a header but no point");
  return {std::move(file), {}};
}

bool known_by_line(const FileStart& start) { return start.line.find(',') != std::string::npos; }

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
