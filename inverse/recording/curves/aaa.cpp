#include "inverse/recording/curves/aaa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "inverse/recording/base/named_curve.hpp"
#include "inverse/recording/curves/aaa_blocks.hpp"
#include "inverse/recording/curves/aaa_row.hpp"

namespace genio {
namespace {

constexpr size_t none = size_t(-1);
constexpr size_t fan_lines = 42;

/// Columns of x and y.
using KnotColumns = std::vector<std::array<size_t, 2>>;

/// Where things stand in a row.
struct Layout {
  KnotColumns knots;
  AaaColumns before;
  // Splines that show points of the head:
  std::vector<std::pair<std::string, KnotColumns>> heads = {};
};

struct KnotTitle {
  int axis = 0;  // 0: X, 1: Y
  int number = 0;
  std::string spline;
};

/// "X12 Tongue" taken apart.
std::optional<KnotTitle> knot_title(const std::string& field) {
  const std::string title = trimmed(field);
  const char axis = title.empty() ? ' ' : lower_case(title)[0];
  if (title.size() < 4 || (axis != 'x' && axis != 'y')) return {};
  const auto blank = title.find(' ');
  if (blank == std::string::npos || blank < 2 || blank > 5) return {};
  int number = 0;
  for (size_t k = 1; k < blank; ++k) {
    if (title[k] < '0' || title[k] > '9') return {};
    number = 10 * number + (title[k] - '0');
  }
  return KnotTitle{axis == 'y', number, trimmed(title.substr(blank))};
}

bool names_knots(const std::vector<std::string>& fields) {
  return std::any_of(fields.begin(), fields.end(),
                     [](const auto& field) { return knot_title(field).has_value(); });
}

/// Columns "X0 Tongue", "Y0 Tongue", ... of the spline that is meant.
Layout from_header(const std::vector<std::string>& header, const ReadOptions& o,
                   const TableLines& lines) {
  std::vector<std::string> splines;
  std::map<std::string, std::map<int, std::array<size_t, 2>>> knots;
  for (size_t c = 0; c < header.size(); ++c) {
    const auto title = knot_title(header[c]);
    if (!title) continue;
    if (!knots.contains(title->spline)) splines.push_back(title->spline);
    const auto it = knots[title->spline].try_emplace(title->number, std::array{none, none}).first;
    size_t& column = it->second[size_t(title->axis)];
    if (column != none)
      lines.fail(fmt::format("columns {} and {} are both called {}", column + 1, c + 1,
                             in_quotes(header[c])));
    column = c;
  }
  Layout layout{{}, aaa_columns(header)};
  const std::string spline =
      named_curve(splines, o, fmt::format("{}:{}", lines.path(), lines.number()));
  for (const auto& [number, columns] : knots[spline]) {
    if (columns[0] == none || columns[1] == none)
      lines.fail(fmt::format("knot {} of spline {} has no column {}", number, in_quotes(spline),
                             columns[0] == none ? "X" : "Y"));
    layout.knots.push_back(columns);
  }
  for (const std::string& name : splines) {
    if (o.role != "tongue" || name == spline || head_points_in(name).empty()) continue;
    auto& [head, columns] = layout.heads.emplace_back(name, KnotColumns());
    for (const auto& [number, pair] : knots[name])
      if (pair[0] != none && pair[1] != none) columns.push_back(pair);
  }
  return layout;
}

/// Without a header: 11 or 14 columns before the knots, told apart by their number. Time and date
/// stand in either order.
Layout without_header(const std::vector<std::string>& fields, const TableLines& lines) {
  const size_t count = fields.size();
  if (count != 11 + 2 * fan_lines && count != 14 + 2 * fan_lines)
    lines.fail(fmt::format(
        "{} columns; expected 95 or 98 (11 or 14 before 42 knots), or a header line", count));
  Layout layout{{}, {.speaker = 0, .recording = 2, .time = 1, .label = 3}};
  double time = 0;
  if (!parse_number(fields[1], time) && parse_number(fields[2], time))
    layout.before.recording = 1, layout.before.time = 2;
  for (size_t c = count - 2 * fan_lines; c + 1 < count; c += 2) layout.knots.push_back({c, c + 1});
  return layout;
}

/// The rows' lengths, held against the first line's. AAA leaves knots that are missing at the end
/// out, and may add an empty field to every row.
class RowLength {
 public:
  RowLength(size_t columns, const TableLines& lines) : columns_(columns), lines_(lines) {}
  void check(const std::vector<std::string>& fields) {
    if (fields.size() < columns_) return;
    const bool adds = fields.size() == columns_ + 1 && trimmed(fields.back()).empty();
    if ((fields.size() > columns_ && !adds) || (added_ && *added_ != adds))
      lines_.fail(
          fmt::format("{} fields; the first line has {}{}. Is there a tab in the prompt or in an "
                      "annotation?",
                      fields.size(), columns_,
                      added_ && *added_ && !adds ? " and the rows before have one more" : ""));
    added_ = adds;
  }

 private:
  size_t columns_;
  const TableLines& lines_;
  std::optional<bool> added_;
};

std::vector<AaaKnot> knots_of(const std::vector<std::string>& fields, const KnotColumns& columns,
                              TableNumbers& numbers, const TableLines& lines) {
  std::vector<AaaKnot> knots;
  for (size_t k = 0; k < columns.size(); ++k) {
    const auto [cx, cy] = columns[k];
    const std::string tx = cx < fields.size() ? fields[cx] : "";
    const std::string ty = cy < fields.size() ? fields[cy] : "";
    if (is_missing(tx) && is_missing(ty)) continue;
    if (std::max(cx, cy) >= fields.size())
      lines.fail(fmt::format("ends in field {}, within knot {}: is the file cut short?",
                             fields.size(), k));
    AaaKnot knot;
    knot.place = k;
    for (const auto& [column, text, value] :
         {std::tuple{cx, &tx, &knot.x}, std::tuple{cy, &ty, &knot.y}})
      if (!numbers.parse(*text, *value))
        lines.fail(fmt::format("knot {}, field {}: {}; expected two numbers, or '*' for both", k,
                               column + 1, numbers.complaint(*text)));
    knots.push_back(knot);
  }
  return knots;
}

RawContours read_cartesian(const std::string& path, const ReadOptions& o) {
  TableLines lines(path);
  RawContours raw{{}, FileAxes{"mm", "right", "up"}};
  ContourFile& file = raw.file;
  file.model_frame = false;
  std::string line = lines.first_filled();
  // AAA writes tabs; a spreadsheet that saved its table, semicolons or commas.
  const char separator = separator_of(line);
  auto fields = split_fields(line, separator);
  const bool header = names_knots(fields);
  const Layout layout = header ? from_header(fields, o, lines) : without_header(fields, lines);
  RowLength length(fields.size(), lines);
  TableNumbers numbers(separator);
  AaaLosses losses;
  if (header && !lines.next_filled(line)) lines.fail("the file has no data row");
  do {
    fields = split_fields(line, separator);
    length.check(fields);
    ContourFrame frame =
        aaa_frame(int(file.frames.size()) + 1, layout.before, fields, numbers, lines);
    add_knots(frame, knots_of(fields, layout.knots, numbers, lines), 0, o.role == "tongue", losses);
    file.frames.push_back(std::move(frame));
    AaaHeadPoints head;
    for (const auto& [spline, columns] : layout.heads)
      head.add(spline, knots_of(fields, columns, numbers, lines), columns.size(), 0);
    head.add_to(file.head_points);
  } while (lines.next_filled(line));
  remark_losses(file, losses, 0);
  if (numbers.has_commas()) file.remarks.push_back("numbers have decimal commas");
  return raw;
}

RawContours read(const std::string& path, const ReadOptions& o) {
  return has_aaa_blocks(path) ? read_aaa_blocks(path, o) : read_cartesian(path, o);
}

/// Without a header, numbers alone are nobody's for sure: AAA's rows have a date, or '*' for what
/// is missing.
bool known_by_line(const FileStart& start) {
  const auto fields = split_fields(start.line, '\t');
  const auto saved = split_fields(start.line, separator_of(start.line));
  if (saved.size() > 2 && names_knots(saved)) return true;
  if (fields.size() < 2) return false;
  if (names_knots(fields) || names_aaa_blocks(start.line)) return true;
  return std::any_of(fields.begin(), fields.end(), [](const std::string& field) {
    const std::string text = trimmed(field);
    const auto slash = text.find('/');
    return text == "*" ||
           (slash != std::string::npos && text.size() < 30 &&
            text.find('/', slash + 1) != std::string::npos && text.find(':') != std::string::npos);
  });
}

}  // namespace

ContourFormat aaa_format() {
  return {.traits = {.name = "aaa", .noise = ultrasound_noise, .facing_by_habit = true},
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
