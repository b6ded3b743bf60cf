#include "inverse/recording/curves/edgetrak.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

/// Fields of a row by its separator, an empty one at the end dropped: tab or comma.
std::vector<std::string> fields_of(const std::string& line, char separator) {
  auto fields = split_fields(line, separator);
  while (!fields.empty() && trimmed(fields.back()).empty()) fields.pop_back();
  return fields;
}

/// "FRAME12" or "12" to 12; 0 where it is no frame's name.
int frame_number(std::string text) {
  text = trimmed(text);
  if (text.starts_with("FRAME")) text.erase(0, 5);
  double n = 0;
  return parse_number(text, n) && n == std::floor(n) && n > 0 && n < 1e9 ? int(n) : 0;
}

RawContours read(const std::string& path, const ReadOptions&) {
  TableLines lines(path);
  RawContours raw{{}, FileAxes{}};
  raw.file.model_frame = false;
  auto& frames = raw.file.frames;
  std::vector<int> numbers;
  char separator = 0;
  size_t columns = 0;
  for (std::string line; lines.next(line);) {
    if (trimmed(line).empty()) continue;
    if (separator == 0) separator = line.find('\t') != std::string::npos ? '\t' : ',';
    if (numbers.empty() && line.starts_with("FRAME")) {
      for (const std::string& field : split_fields(line, separator))
        if (const int n = frame_number(field)) numbers.push_back(n);
      continue;
    }
    auto fields = fields_of(line, separator);
    if (frames.empty() && !fields.empty() && trimmed(fields.front()) == "X") continue;
    // EdgeTrak indents its rows.
    size_t first = 0;
    while (first < fields.size() && trimmed(fields[first]).empty()) ++first;
    fields.erase(fields.begin(), fields.begin() + long(first));
    if (columns == 0) {
      columns = fields.size();
      if (columns % 2 != 0)
        lines.fail(fmt::format("{} columns; expected pairs x, y, one a frame", columns));
      frames.resize(columns / 2);
      for (size_t k = 0; k < frames.size(); ++k)
        frames[k].number = k < numbers.size() ? numbers[k] : int(k + 1);
    }
    if (fields.size() != columns)
      lines.fail(fmt::format("{} fields; the first row has {}", fields.size(), columns));
    for (size_t k = 0; k < frames.size(); ++k) {
      const std::string tx = trimmed(fields[2 * k]), ty = trimmed(fields[2 * k + 1]);
      if (tx == "NaN" || tx.empty()) continue;
      double x = 0, y = 0;
      if (!parse_number(tx, x) || !parse_number(ty, y))
        lines.fail(fmt::format("fields {}, {}: '{}', '{}'; expected two numbers", 2 * k + 1,
                               2 * k + 2, tx, ty));
      frames[k].points.push_back({{x, not_given, y}, 0, "curve"});
    }
  }
  if (frames.empty()) lines.fail("the file has no point");
  return raw;
}

/// Tables separated by commas whose first field is a number have no header.
bool known_by_line(const FileStart& start) {
  const std::string& line = start.line;
  if (line.starts_with("FRAME") || start.ending == ".con") return true;
  double first = 0;
  return line.find('\t') == std::string::npos && line.find("frame") == std::string::npos &&
         line.find(',') != std::string::npos &&
         parse_number(split_fields(line, ',').front(), first);
}

}  // namespace

ContourFormat edgetrak_format() {
  return {.traits = {.name = "edgetrak", .noise = ultrasound_noise},
          .about = ".con and _EdgeTrak.tsv files, and plain tables of x, y columns",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "word.con",
                      .text = "55\t95\t55\t96\n75\t110\t75\t111\n95\t115\t95\t116\n",
                      .options = {}}};
}

}  // namespace genio
