#include "inverse/recording/curves/aaa.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <regex>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/curves/aaa_polar.hpp"

namespace genio {
namespace {

constexpr double longest_gap = 12;  // between neighbouring knots of one contour [mm]

/// Where things stand in a row.
struct Layout {
  std::vector<std::pair<size_t, size_t>> knots;  // columns of x and y
  size_t label = 3, time = 1;
};

/// Columns "X0 Tongue", "Y0 Tongue", ... of the first spline named in a header.
Layout from_header(const std::vector<std::string>& header, const TableLines& lines) {
  Layout layout;
  const std::regex knot(R"(^([XY])(\d+)\s+(.*)$)");
  std::string spline;
  std::smatch m, my;
  for (size_t c = 0; c + 1 < header.size(); ++c) {
    const std::string name = trimmed(header[c]), next = trimmed(header[c + 1]);
    if (name == "Prompt") layout.label = c;
    if (name == "Time of sample in recording") layout.time = c;
    if (!std::regex_match(name, m, knot) || m[1] != "X") continue;
    if (!std::regex_match(next, my, knot) || my[1] != "Y" || my[2] != m[2]) continue;
    if (spline.empty()) spline = m[3];
    if (m[3] == spline) layout.knots.emplace_back(c, c + 1);
  }
  if (layout.knots.empty()) lines.fail("the header names no knots 'X0 ...', 'Y0 ...'");
  return layout;
}

/// Without a header: 11 or 14 columns before the knots, told apart by their number.
Layout without_header(size_t fields, const TableLines& lines) {
  Layout layout;
  size_t meta = 0;
  for (size_t m : {size_t(14), size_t(11)})
    if (fields == m + 84) meta = m;
  if (meta == 0)
    lines.fail(fmt::format(
        "{} columns; expected 95 or 98 (11 or 14 before 42 knots), or a header line", fields));
  for (size_t c = meta; c + 1 < fields; c += 2) layout.knots.emplace_back(c, c + 1);
  return layout;
}

/// Longest run of knots without a wide gap: the outermost knots are often tracker noise.
std::vector<ContourPoint> longest_run(const std::vector<ContourPoint>& points) {
  std::vector<ContourPoint> best, run;
  for (const auto& p : points) {
    if (!run.empty() && (Eigen::Vector2d(p.position[0], p.position[2]) -
                         Eigen::Vector2d(run.back().position[0], run.back().position[2]))
                                .norm() > longest_gap)
      run.clear();
    run.push_back(p);
    if (run.size() > best.size()) best = run;
  }
  return best;
}

RawContours read_cartesian(const std::string& path) {
  TableLines lines(path);
  RawContours raw{{}, FileAxes{"mm", "right", "up"}};
  ContourFile& file = raw.file;
  file.model_frame = false;
  Layout layout;
  size_t columns = 0;
  int row = 0;
  for (std::string line; lines.next(line);) {
    if (trimmed(line).empty()) continue;
    const auto fields = split_fields(line, '\t');
    if (columns == 0) {
      columns = fields.size();
      const bool header = line.find("X0 ") != std::string::npos;
      layout = header ? from_header(fields, lines) : without_header(columns, lines);
      if (header) continue;
    }
    // AAA leaves trailing missing knots out, or adds an empty field at the end.
    if (fields.size() > columns + 1)
      lines.fail(fmt::format("{} fields; the first line has {}", fields.size(), columns));
    ContourFrame frame;
    frame.number = ++row;
    if (layout.label < fields.size()) frame.label = trimmed(fields[layout.label]);
    if (layout.time < fields.size()) parse_number(fields[layout.time], frame.time_s);
    for (size_t k = 0; k < layout.knots.size(); ++k) {
      const auto [cx, cy] = layout.knots[k];
      const std::string tx = cx < fields.size() ? trimmed(fields[cx]) : "";
      const std::string ty = cy < fields.size() ? trimmed(fields[cy]) : "";
      const bool missing_x = tx.empty() || tx == "*", missing_y = ty.empty() || ty == "*";
      if (missing_x && missing_y) continue;
      double x = 0, y = 0;
      if (!parse_number(tx, x) || !parse_number(ty, y))
        lines.fail(
            fmt::format("knot {}: '{}', '{}'; expected two finite numbers or '*'", k, tx, ty));
      ContourPoint p;
      p.position = {x, std::numeric_limits<double>::quiet_NaN(), y};
      p.kind = "curve";
      frame.points.push_back(std::move(p));
    }
    const size_t valid = frame.points.size();
    frame.points = longest_run(frame.points);
    if (valid == 0) frame.note = "the frame is empty (no knot has a value)";
    file.frames.push_back(std::move(frame));
  }
  if (file.frames.empty()) lines.fail("the file has no data row");
  return raw;
}

RawContours read(const std::string& path, const ReadOptions&) {
  return has_polar_blocks(path) ? read_aaa_polar(path) : read_cartesian(path);
}

bool known_by_line(const FileStart& start) { return start.line.find('\t') != std::string::npos; }

}  // namespace

ContourFormat aaa_format() {
  return {.traits = {.name = "aaa", .noise = ultrasound_noise},
          .about = "AAA exports, Cartesian and polar, with or without header",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "export.txt",
                      .text = "Prompt\tTime of sample in recording\tX0 Tongue\tY0 Tongue\t"
                              "X1 Tongue\tY1 Tongue\nword\t0.5\t-10\t55\t-40\t60\n",
                      .options = {}}};
}

}  // namespace genio
