#include "inverse/recording/curves/edgetrak.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "forward/base/median.hpp"
#include "inverse/recording/base/file_axes.hpp"
#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

constexpr size_t most_columns = 200000;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double far_off = 5;  // of a point from its neighbours, in usual distances

using Rows = std::vector<std::vector<double>>;

/// "FRAME12" or "12" to 12; 0 where it is no frame's name.
int frame_number(std::string text) {
  text = trimmed(text);
  if (text.starts_with("FRAME")) text.erase(0, 5);
  double n = 0;
  return parse_number(text, n) && n == std::floor(n) && n > 0 && n < 1e9 ? int(n) : 0;
}

struct Table {
  std::vector<int> numbers;  // of frames, where the file says them
  Rows rows;                 // NaN: missing
  bool commas = false;
};

/// Empty fields before the first value: EdgeTrak indents its rows.
size_t indentation(const std::vector<std::string>& fields) {
  size_t first = 0;
  while (first < fields.size() && trimmed(fields[first]).empty()) ++first;
  return first;
}

Table table_of(TableLines& lines) {
  Table t;
  std::string line;
  char separator = 0;
  size_t indent = 0, columns = 0;
  TableNumbers numbers(' ');
  while (lines.next_filled(line)) {
    if (separator == 0) separator = separator_of(line), numbers = TableNumbers(separator);
    auto fields = fields_of(line, separator);
    if (t.numbers.empty() && t.rows.empty() && line.starts_with("FRAME")) {
      for (const std::string& field : fields)
        if (const int n = frame_number(field)) t.numbers.push_back(n);
      continue;
    }
    if (t.rows.empty() && trimmed(fields.front()) == "X") continue;
    if (columns == 0) {
      indent = indentation(fields);
      if (indent == fields.size()) continue;  // separators alone
      while (fields.size() > indent && trimmed(fields.back()).empty()) fields.pop_back();
      columns = fields.size() - indent;
      if (columns > most_columns)
        lines.fail(fmt::format("{} columns; expected at most {}", columns, most_columns));
    }
    fields.erase(fields.begin(), fields.begin() + long(std::min(indent, indentation(fields))));
    while (fields.size() > columns && trimmed(fields.back()).empty()) fields.pop_back();
    if (fields.size() > columns) lines.fail(other_count(fields.size(), "first row", columns, line));
    if (fields.size() < columns)
      lines.fail(
          fmt::format("{} fields; the first row has {}. Points that are missing are empty "
                      "fields or NaN",
                      fields.size(), columns));
    auto& row = t.rows.emplace_back(columns, missing);
    for (size_t c = 0; c < columns; ++c)
      if (!is_missing(fields[c]) && !numbers.parse(fields[c], row[c]))
        lines.fail(fmt::format("fields {}, {}: {}; expected two numbers", c / 2 * 2 + 1,
                               c / 2 * 2 + 2, numbers.complaint(fields[c])));
    for (size_t c = 0; c + 1 < columns && columns % 2 == 0; c += 2)
      if (std::isnan(row[c]) != std::isnan(row[c + 1]))
        lines.fail(fmt::format("fields {}, {}: x without y; expected two numbers", c + 1, c + 2));
  }
  t.commas = numbers.has_commas();
  if (t.rows.empty()) lines.fail("the file has no point");
  return t;
}

bool counts_up(const Rows& rows) {
  for (size_t k = 0; k < rows.size(); ++k)
    if (rows[k][0] != rows[0][0] + double(k)) return false;
  return rows.size() > 2 && (rows[0][0] == 0 || rows[0][0] == 1);
}

/// True where every third column, from that one on, lies between 0 and 1 as likelihoods do.
bool has_likelihoods(const Rows& rows, size_t first) {
  if (rows[0].size() % 3 != (first + 1) % 3 || rows[0].size() < first + 4) return false;
  bool larger = false;  // what is not a likelihood
  for (const auto& row : rows)
    for (size_t c = 0; c < row.size(); ++c)
      if (c >= first && c % 3 == first % 3 && !(row[c] >= 0 && row[c] <= 1)) return false;
      else larger = larger || row[c] > 1;
  return larger;
}

void refuse_tracks(const Rows& rows, const TableLines& lines) {
  for (const size_t first : {size_t(2), size_t(3)})
    if (has_likelihoods(rows, first))
      throw InputError(fmt::format(
          "{}: {} columns, of which every third from column {} on lies between 0 and 1: rows of "
          "DeepLabCut without their three header rows (scorer, bodyparts, coords)? They are no "
          "pairs x, y; give the file with its header",
          lines.path(), rows[0].size(), first + 1));
  if (counts_up(rows))
    throw InputError(fmt::format(
        "{}: the first column counts the rows from {:g}: an index is no x. Expected pairs x, y; "
        "name the columns of another table with a header and --columns",
        lines.path(), rows[0][0]));
}

bool is_corner(const ContourPoint& p) { return p.position[0] == 0 && p.position[2] == 0; }

/// Takes "0 0" at the end of a contour away. Gives their number.
size_t drop_padding(ContourFrame& frame, const TableLines& lines) {
  auto& points = frame.points;
  size_t padded = 0;
  while (!points.empty() && is_corner(points.back())) points.pop_back(), ++padded;
  std::vector<double> steps;
  for (size_t k = 1; k < points.size(); ++k) {
    const Vec3 step = points[k].position - points[k - 1].position;
    steps.push_back(std::hypot(step[0], step[2]));
  }
  if (steps.empty()) return padded;
  const double usual = median(steps);
  for (size_t k = 0; k < points.size(); ++k) {
    const double before = k > 0 ? steps[k - 1] : 0, after = k < steps.size() ? steps[k] : 0;
    if (is_corner(points[k]) && std::max(before, after) > far_off * usual)
      throw InputError(fmt::format(
          "{}: contour {}, point {}: '0 0' far from its neighbours; write NaN for what is missing",
          lines.path(), frame.number, k + 1));
  }
  return padded;
}

RawContours read(const std::string& path, const ReadOptions&) {
  TableLines lines(path);
  const Table t = table_of(lines);
  refuse_tracks(t.rows, lines);
  if (t.rows[0].size() % 2 != 0)
    throw InputError(
        fmt::format("{}: {} columns; expected pairs x, y, one a frame", path, t.rows[0].size()));
  RawContours raw{{}, FileAxes{}};
  raw.file.model_frame = false;
  auto& frames = raw.file.frames;
  frames.resize(t.rows[0].size() / 2);
  if (!t.numbers.empty() && t.numbers.size() != frames.size())
    throw InputError(fmt::format("{}: {} frames are named, and there are {} pairs of columns", path,
                                 t.numbers.size(), frames.size()));
  std::set<int> named;
  size_t padded = 0, contours = 0;
  for (size_t k = 0; k < frames.size(); ++k) {
    frames[k].number = k < t.numbers.size() ? t.numbers[k] : int(k + 1);
    if (!named.insert(frames[k].number).second)
      throw InputError(fmt::format("{}: two contours are called FRAME{}", path, frames[k].number));
    for (const auto& row : t.rows)
      if (!std::isnan(row[2 * k]))
        frames[k].points.push_back({{row[2 * k], not_given, row[2 * k + 1]}, 0, "curve"});
    const size_t dropped = drop_padding(frames[k], lines);
    padded += dropped, contours += dropped > 0;
    if (frames[k].points.empty()) frames[k].note = "the frame is empty (no point has a value)";
  }
  if (padded > 0)
    raw.file.remarks.push_back(
        fmt::format("{} pairs '0 0' at the ends of {} contours are taken for missing points",
                    padded, contours));
  if (t.commas) raw.file.remarks.push_back("numbers have decimal commas");
  return raw;
}

/// Tables of numbers, separated by commas or semicolons, have no header.
bool known_by_line(const FileStart& start) {
  const std::string& line = start.line;
  if (line.starts_with("FRAME") || start.ending == ".con") return true;
  const char separator = separator_of(line);
  if (separator != ',' && separator != ';') return false;
  TableNumbers numbers(separator);
  double first = 0;
  return line.find("frame") == std::string::npos &&
         numbers.parse(split_fields(line, separator).front(), first);
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
