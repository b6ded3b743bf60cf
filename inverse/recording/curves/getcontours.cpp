#include "inverse/recording/curves/getcontours.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "inverse/recording/base/file_axes.hpp"
#include "inverse/recording/base/frame_rows.hpp"

namespace genio {
namespace {

/// Where the numbers of a row stand. Long tables have one knot a row, wide ones all of a frame.
struct Layout {
  size_t frame = 0, time = 0;
  std::optional<size_t> note, point;
  std::vector<std::pair<size_t, size_t>> knots;
  bool wide = false, millimetres = false;
};

Layout layout_of(const std::vector<std::string>& header, const TableLines& lines) {
  std::map<std::string, size_t> at;
  for (size_t c = 0; c < header.size(); ++c) at.emplace(trimmed(header[c]), c);
  for (const char* needed : {"FRAME", "TIME"})
    if (!at.contains(needed)) lines.fail(fmt::format("column {} is missing", needed));
  Layout l;
  l.frame = at["FRAME"], l.time = at["TIME"];
  if (at.contains("NOTE")) l.note = at["NOTE"];
  if (at.contains("POINT")) l.point = at["POINT"];
  const auto pair = [&](const std::string& x, const std::string& y) {
    if (!at.contains(x) || !at.contains(y)) return false;
    l.knots.emplace_back(at[x], at[y]);
    return true;
  };
  if (pair("mmX", "mmY")) return l.millimetres = true, l;
  if (pair("X", "Y")) return l;
  l.wide = true;
  for (const std::string prefix : {"mm", ""})
    for (int k = 1; l.knots.empty() || l.knots.size() == size_t(k - 1); ++k)
      if (!pair(fmt::format("{}X{:03d}", prefix, k), fmt::format("{}Y{:03d}", prefix, k))) break;
      else l.millimetres = !prefix.empty();
  if (l.knots.empty()) lines.fail("no columns X, Y or X001, Y001, ... (or mmX, mmY, ...)");
  return l;
}

RawContours read(const std::string& path, const ReadOptions&) {
  TableLines lines(path);
  std::string line = lines.first_filled();
  const auto header = split_fields(line, '\t');
  const Layout l = layout_of(header, lines);
  RawContours raw{{}, FileAxes{l.millimetres ? "mm" : "px", "", l.millimetres ? "" : "down"}};
  raw.file.model_frame = false;
  FrameRows frames(lines);
  TableNumbers numbers('\t');
  while (lines.next_filled(line)) {
    auto fields = split_fields(line, '\t');
    if (fields.size() == header.size() + 1 && trimmed(fields.back()).empty()) fields.pop_back();
    if (fields.size() != header.size())
      lines.fail(fmt::format("{} fields; the header has {}. Is there a tab in the note?",
                             fields.size(), header.size()));
    const auto number = [&](size_t column) {
      double value = 0;
      if (!numbers.parse(fields[column], value))
        lines.fail(fmt::format("field {}: {}", trimmed(header[column]),
                               numbers.complaint(fields[column])));
      return value;
    };
    const double n = number(l.frame);
    if (n != std::floor(n) || std::abs(n) > 1e9)
      lines.fail(fmt::format("field FRAME: {} is no whole number", in_quotes(fields[l.frame])));
    RowFrame row{int(n), "", "", l.note ? trimmed(fields[*l.note]) : "", {}};
    if (!is_missing(fields[l.time])) row.time_s = number(l.time);
    ContourFrame& frame = frames.frame(row);
    if (l.wide) frames.count("row", 1);
    else if (l.point) frames.count("point", number(*l.point));
    else frames.expect_together();
    for (const auto& [cx, cy] : l.knots) {
      if (is_missing(fields[cx]) && is_missing(fields[cy])) continue;
      const double x = number(cx), y = number(cy);
      frame.points.push_back({{x, not_given, y}, 0, "curve"});
    }
  }
  raw.file.frames = frames.take();
  if (numbers.has_commas()) raw.file.remarks.push_back("numbers have decimal commas");
  return raw;
}

bool known_by_line(const FileStart& start) { return start.line.starts_with("FRAME\tTIME"); }

}  // namespace

ContourFormat getcontours_format() {
  ReadOptions pixels;
  pixels.mm_per_px = 0.2;
  return {.traits = {.name = "getcontours", .noise = ultrasound_noise},
          .about = "tables of GetContours, long or wide, in mm or pixels",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "word.tsv",
                      .text = "FRAME\tTIME\tNOTE\tPOINT\tX\tY\n7\t0.1\tword\t1\t275\t475\n"
                              "7\t0.1\tword\t2\t375\t400\n7\t0.1\tword\t3\t475\t375\n",
                      .options = pixels}};
}

}  // namespace genio
