#include "inverse/recording/curves/getcontours.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

/// Where the numbers of a row stand. Long tables have one knot a row, wide ones all of a frame.
struct Layout {
  size_t frame = 0, time = 0, note = 0;
  bool has_note = false;
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
  if (at.contains("NOTE")) l.note = at["NOTE"], l.has_note = true;
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
  std::string line;
  if (!lines.next(line)) lines.fail("the file is empty; expected a header line");
  const auto header = split_fields(line, '\t');
  const Layout l = layout_of(header, lines);
  RawContours raw{{}, FileAxes{l.millimetres ? "mm" : "px", "", l.millimetres ? "" : "down"}};
  raw.file.model_frame = false;
  std::map<int, size_t> index;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const auto fields = split_fields(line, '\t');
    if (fields.size() < header.size())
      lines.fail(fmt::format("{} fields; the header has {}", fields.size(), header.size()));
    double number = 0, time = 0;
    if (!parse_number(fields[l.frame], number) || number != std::floor(number) ||
        std::abs(number) > 1e9)
      lines.fail(fmt::format("field FRAME: '{}' is no whole number", fields[l.frame]));
    parse_number(fields[l.time], time);
    const auto [it, fresh] = index.try_emplace(int(number), raw.file.frames.size());
    if (fresh) {
      ContourFrame& frame = raw.file.frames.emplace_back();
      frame.number = int(number), frame.time_s = time;
      if (l.has_note) frame.label = trimmed(fields[l.note]);
    }
    for (const auto& [cx, cy] : l.knots) {
      const std::string tx = trimmed(fields[cx]), ty = trimmed(fields[cy]);
      if (tx.empty() || tx == "NaN") continue;
      double x = 0, y = 0;
      if (!parse_number(tx, x) || !parse_number(ty, y))
        lines.fail(fmt::format("fields {}, {}: '{}', '{}'; expected two numbers", header[cx],
                               header[cy], tx, ty));
      raw.file.frames[it->second].points.push_back({{x, not_given, y}, 0, "curve"});
    }
  }
  if (raw.file.frames.empty()) lines.fail("the file has a header but no point");
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
