#include "inverse/recording/formats/csv.hpp"

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

RawContours read(const std::string& path, const ReadOptions&) {
  TableLines lines(path);
  std::string line;
  if (!lines.next(line)) lines.fail("the file is empty; expected a header line");
  std::map<std::string, size_t> column;
  const auto header = split_fields(line, ',');
  for (size_t c = 0; c < header.size(); ++c) {
    const std::string name = trimmed(header[c]);
    if (std::find(known_columns.begin(), known_columns.end(), name) == known_columns.end())
      lines.fail(fmt::format("unknown column '{}'; did you mean {}?", name,
                             nearest_name(name, known_columns)));
    if (!column.emplace(name, c).second) lines.fail(fmt::format("column '{}' stands twice", name));
  }
  for (const char* needed : {"frame", "x_mm", "z_mm"})
    if (!column.contains(needed)) lines.fail(fmt::format("column '{}' is missing", needed));

  ContourFile file;
  std::map<int, size_t> index;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const auto fields = split_fields(line, ',');
    if (fields.size() != header.size())
      lines.fail(fmt::format("{} fields; the header has {}", fields.size(), header.size()));
    const auto number = [&](const std::string& name) {
      double v = 0;
      if (!parse_number(fields[column.at(name)], v))
        lines.fail(
            fmt::format("field {}: '{}' is not a finite number", name, fields[column.at(name)]));
      return v;
    };
    const double frame = number("frame");
    if (frame != std::floor(frame) || std::abs(frame) > 1e9)
      lines.fail(fmt::format("field frame: {} is not a whole number", frame));
    const auto [it, fresh] = index.try_emplace(int(frame), file.frames.size());
    if (fresh) file.frames.emplace_back().number = int(frame);
    ContourFrame& f = file.frames[it->second];
    ContourPoint p;
    const bool has_y = column.contains("y_mm") && !trimmed(fields[column["y_mm"]]).empty();
    p.position = 1e-3 * Vec3(number("x_mm"), has_y ? number("y_mm") : 0, number("z_mm"));
    if (!has_y) p.position[1] = std::numeric_limits<double>::quiet_NaN();
    if (column.contains("sigma_mm") && !trimmed(fields[column["sigma_mm"]]).empty()) {
      p.sigma = 1e-3 * number("sigma_mm");
      if (!(p.sigma > 0)) lines.fail("field sigma_mm: must be above 0");
    }
    p.kind = column.contains("kind") ? trimmed(fields[column["kind"]]) : "";
    if (p.kind.empty()) p.kind = "curve";
    if (p.kind == "surface" && !has_y) lines.fail("a surface point needs y_mm");
    if (p.kind == "volume") {
      for (const char* needed : {"rest_x_mm", "rest_y_mm", "rest_z_mm"})
        if (!column.contains(needed))
          lines.fail(fmt::format("a volume point needs column '{}'", needed));
      p.rest = 1e-3 * Vec3(number("rest_x_mm"), number("rest_y_mm"), number("rest_z_mm"));
    }
    if (column.contains("slice")) {
      const double slice = number("slice");
      if (slice != std::floor(slice) || std::abs(slice) > 1e6)
        lines.fail(fmt::format("field slice: {} is not a whole number", slice));
      p.slice = int(slice);
    }
    if (column.contains("label") && f.label.empty()) f.label = trimmed(fields[column["label"]]);
    if (column.contains("time_s") && !trimmed(fields[column["time_s"]]).empty())
      f.time_s = number("time_s");
    f.points.push_back(std::move(p));
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
