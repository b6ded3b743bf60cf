#include "inverse/recording/curves/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inverse/recording/base/confidence.hpp"
#include "inverse/recording/base/frame_rows.hpp"
#include "inverse/recording/curves/column_roles.hpp"

namespace genio {
namespace {

constexpr double least_likelihood = 0.6;

/// Looks at a column of no role while the rows of one frame pass: it may tell that they are two.
class Witness {
 public:
  /// Throws InputError where the column counts the points of a frame again.
  void see(const std::string& value, const std::string& title, bool fresh, int frame,
           const TableLines& lines) {
    double number = 0;
    const bool numeric = parse_number(value, number);
    if (fresh) {
      first_ = number, counts_ = numeric, rows_ = 0, changes_ = 0;
    } else if (numeric && counts_ && number == first_ && rows_ > 1 && last_number_ != number) {
      lines.fail(fmt::format(
          "frame {}: column {} counts from {:g} again: two takes? Say which column tells them "
          "apart, --columns recording=TITLE",
          frame, in_quotes(title), number));
    } else {
      counts_ = counts_ && numeric && number == last_number_ + 1;
      changes_ += value != last_;
    }
    ++rows_, last_ = value, last_number_ = number;
  }
  /// True where it stays the same for many rows of a frame, and then changes.
  bool parts_the_frame() const { return changes_ > 0 && rows_ > 3 && 4 * changes_ < rows_; }

 private:
  double first_ = 0, last_number_ = 0;
  std::string last_;
  bool counts_ = false;
  int rows_ = 0, changes_ = 0;
};

/// Numbers of frames: the table's own, or those of their order where it has other names for them.
class FrameNumbers {
 public:
  int of(const std::string& key, const std::string& name, const TableLines& lines) {
    double n = 0;
    const bool whole =
        parse_number(name, n) && n == std::floor(n) && n >= 0 && n < 1e9 && !name.empty();
    if (first_) own_ = whole, from_zero_ = whole && n == 0, first_ = false;
    if (!own_) return order_.try_emplace(key + '\n' + name, int(order_.size()) + 1).first->second;
    if (!whole || (n == 0 && !from_zero_))
      lines.fail(
          fmt::format("column of the frame: {}; expected a whole number, as in the rows "
                      "before",
                      in_quotes(name)));
    return int(n) + (from_zero_ ? 1 : 0);
  }
  bool from_zero() const { return from_zero_; }

 private:
  bool first_ = true, own_ = false, from_zero_ = false;
  std::map<std::string, int> order_;
};

class Reader {
 public:
  Reader(const std::string& path, const ReadOptions& o)
      : lines_(path), numbers_(' '), rows_(lines_) {
    std::string line = lines_.first_filled();
    separator_ = separator_of(line);
    numbers_ = TableNumbers(separator_);
    titles_ = fields_of(line, separator_);
    std::string unknown;
    roles_ = o.columns.empty() ? guessed_roles(titles_, unknown)
                               : named_roles(titles_, o.columns, lines_);
    if (!unknown.empty() || !roles_.has("x") || !roles_.has("y"))
      lines_.fail(fmt::format(
          "{}; say what the columns are, --columns x=TITLE,y=TITLE,frame=TITLE,recording=TITLE",
          unknown.empty() ? "no column is called x or y"
                          : fmt::format("column {} tells nothing for sure", in_quotes(unknown))));
    witnesses_.resize(roles_.others.size());
    while (lines_.next_filled(line)) read_row(fields_of(line, separator_), line);
    end_frame();
  }

  RawContours contours(const ReadOptions& o) {
    std::string units = unit_of("x");
    if (unit_of("y") != units || (units.empty() && in_pixels(o))) units = in_pixels(o) ? "px" : "";
    RawContours raw{{}, FileAxes{units, "", units == "px" ? "down" : ""}};
    raw.file.model_frame = false;
    raw.file.frames = rows_.take();
    auto& remarks = raw.file.remarks;
    if (!roles_.has("frame") && !roles_.has("time"))
      remarks.push_back("no column of frames: one contour a recording and label");
    if (frames_.from_zero())
      remarks.push_back("the file counts frames from 0; they are counted from 1 here");
    if (unsure_ > 0)
      remarks.push_back(fmt::format("{} of {} points left out: their likelihood is below {:g}",
                                    unsure_, all_, least_likelihood));
    if (numbers_.has_commas()) remarks.push_back("numbers have decimal commas");
    return raw;
  }

 private:
  std::string title(const std::string& role) const {
    return lower_case(trimmed(titles_[roles_.of.at(role).front()]));
  }
  std::string unit_of(const std::string& role) const {
    for (const char* unit : {"px", "mm", "cm"})
      if (title(role).ends_with(std::string("_") + unit) ||
          title(role).ends_with(std::string(".") + unit))
        return unit;
    return "";
  }
  /// MTracker's tables are in pixels.
  bool in_pixels(const ReadOptions& o) const {
    return o.units == "px" || o.mm_per_px > 0 ||
           (roles_.has("frame") && title("frame") == "uniqueframe");
  }

  /// R leaves the title of its names of rows out.
  size_t offset(const std::vector<std::string>& fields, const std::string& line) {
    const size_t more = fields.size() == titles_.size() + 1 ? 1 : 0;
    if (fields.size() != titles_.size() + more || (more_ && *more_ != more))
      lines_.fail(other_count(fields.size(), "header", titles_.size(), line));
    more_ = more;
    return more;
  }

  void end_frame() {
    for (size_t k = 0; k < witnesses_.size(); ++k)
      if (witnesses_[k].parts_the_frame())
        lines_.fail(fmt::format(
            "column {} changes within frame {}, which ends here: say what it is, as in --columns "
            "recording={}",
            in_quotes(titles_[roles_.others[k]]), current_, trimmed(titles_[roles_.others[k]])));
  }

  void read_row(const std::vector<std::string>& fields, const std::string& line) {
    const size_t more = offset(fields, line);
    const auto text = [&](const std::string& role) {
      std::string result;
      if (roles_.has(role))
        for (const size_t c : roles_.of.at(role))
          result += (result.empty() ? "" : " ") + trimmed(fields[c + more]);
      return result;
    };
    const auto number = [&](const std::string& role) {
      double value = 0;
      if (!numbers_.parse(text(role), value))
        lines_.fail(
            fmt::format("column {}: {}", in_quotes(title(role)), numbers_.complaint(text(role))));
      return value;
    };
    RowFrame row{1, text("recording"), text("speaker"), text("label"), {}};
    const std::string key = row.recording + '\n' + row.speaker;
    if (roles_.has("frame")) row.number = frames_.of(key, text("frame"), lines_);
    else if (roles_.has("time")) row.number = frames_.of(key, "t " + text("time"), lines_);
    else row.number = frames_.of(key, "l " + row.label, lines_);
    if (roles_.has("time") && !is_missing(text("time"))) row.time_s = number("time");
    ContourFrame& frame = rows_.frame(row);
    if (roles_.has("point")) rows_.count("point", number("point"));
    else rows_.expect_together();
    begin_row(fields, more, row);
    if (is_missing(text("x")) && is_missing(text("y"))) return;
    const double x = number("x"), y = number("y");
    ++all_;
    double widening = 1;
    if (roles_.has("likelihood") && !is_missing(text("likelihood"))) {
      const double p = number("likelihood");
      if (p < 0 || p > 1)
        lines_.fail(
            fmt::format("column {}: {:g}; expected 0 to 1", in_quotes(title("likelihood")), p));
      if (p < least_likelihood) {
        ++unsure_;
        return;
      }
      widening = widening_by_likelihood(p);
    }
    ContourPoint& point = frame.points.emplace_back();
    point.position = {x, not_given, y}, point.kind = "curve", point.widening = widening;
  }

  void begin_row(const std::vector<std::string>& fields, size_t more, const RowFrame& row) {
    const std::string key = fmt::format("{}\n{}\n{}", row.number, row.recording, row.speaker);
    const bool fresh = key != key_;
    if (fresh && !key_.empty()) end_frame();
    key_ = key, current_ = row.number;
    for (size_t k = 0; k < witnesses_.size() && !roles_.has("point"); ++k)
      witnesses_[k].see(trimmed(fields[roles_.others[k] + more]), titles_[roles_.others[k]], fresh,
                        row.number, lines_);
  }

  TableLines lines_;
  TableNumbers numbers_;
  FrameRows rows_;
  FrameNumbers frames_;
  char separator_ = ',';
  std::vector<std::string> titles_;
  ColumnRoles roles_;
  std::vector<Witness> witnesses_;
  std::optional<size_t> more_;
  std::string key_;
  int current_ = 0;
  size_t all_ = 0, unsure_ = 0;
};

RawContours read(const std::string& path, const ReadOptions& o) {
  return Reader(path, o).contours(o);
}

/// A header whose titles tell all: x, y and nothing that is not known.
bool known_by_line(const FileStart& start) {
  std::string unknown;
  const auto titles = fields_of(start.line, separator_of(start.line));
  const ColumnRoles roles = guessed_roles(titles, unknown);
  // The table of the README has x_mm and y_mm too, and y across.
  if (std::any_of(titles.begin(), titles.end(),
                  [](const auto& title) { return lower_case(trimmed(title)) == "z_mm"; }))
    return false;
  return roles.has("x") && roles.has("y") && (unknown.empty() || roles.has("frame"));
}

}  // namespace

ContourFormat columns_format() {
  ReadOptions pixels;
  pixels.mm_per_px = 0.25;
  return {.traits = {.name = "columns", .noise = ultrasound_noise},
          .about = "any long table, a row a point, with --columns; MTracker, R, pandas",
          .known_by_bytes = {},
          .known_by_line = known_by_line,
          .read = read,
          .example = {.name = "points.csv",
                      .text = ",x,y,uniqueframe\n0,220,380,7\n1,300,340,7\n2,380,330,7\n",
                      .options = pixels}};
}

}  // namespace genio
