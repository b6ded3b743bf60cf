#include "speaker/slices/contour_stack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "speaker/solid/table_columns.hpp"

namespace genio {
namespace {

constexpr size_t most_slices = 2000, most_outlines = 200, most_points = 10000;  // a slice
constexpr size_t most_in_all = 1000000;                                         // points
constexpr double stack_mm = 1e-3, same_place = 1e-9;                            // [m]
constexpr double farthest_mm = 1e6;

enum StackColumn : size_t { col_slice, col_point, col_x, col_y, col_z, col_contour, column_count };
constexpr std::array<const char*, column_count> column_names = {"slice", "point", "x_mm",
                                                                "y_mm",  "z_mm",  "contour"};

/// Where the columns stand; the last may be missing, and is then past the end.
std::array<size_t, column_count> stack_columns(const std::vector<std::string>& header,
                                               const TablePlace& place) {
  std::array<size_t, column_count> at{};
  for (size_t k = 0; k < column_count; ++k) {
    at[k] = column_named(header, column_names[k]);
    if (at[k] == header.size() && k != col_contour)
      place.fail(
          fmt::format("no column {}; expected slice, point, x_mm, y_mm, z_mm and perhaps "
                      "contour",
                      column_names[k]));
  }
  return at;
}

/// Takes rows in turn.
class StackRows {
 public:
  StackRows(const TableLines& lines, ContourStack& stack) : lines_(lines), stack_(stack) {}

  void add(const std::string& slice, const std::string& contour, double point, const Vec3& at) {
    if (stack_.slices.empty() || stack_.slices.back().name != slice) {
      finish_outline();
      if (!seen_.insert(slice).second)
        lines_.fail(fmt::format("slice {} comes again; expected the rows of a slice together",
                                in_quotes(slice)));
      if (stack_.slices.size() >= most_slices)
        lines_.fail(fmt::format("expected at most {} slices", most_slices));
      stack_.slices.push_back({slice, {}});
      in_slice_ = 0;
    } else if (contour != contour_ || (contour.empty() && point <= first_point_)) {
      finish_outline();
    } else if (point <= last_point_) {
      lines_.fail(
          fmt::format("column point: {} does not follow {}; expected the points of an "
                      "outline in turn",
                      point, last_point_));
    }
    if (outline_.empty()) first_point_ = point;
    if (in_slice_++ >= most_points)
      lines_.fail(fmt::format("expected at most {} points a slice", most_points));
    if (in_all_++ >= most_in_all)
      lines_.fail(fmt::format("expected at most {} points in all", most_in_all));
    contour_ = contour;
    last_point_ = point;
    outline_.push_back(at);
  }

  void finish_outline() {
    if (outline_.empty()) return;
    StackSlice& slice = stack_.slices.back();
    const auto same = [](const Vec3& a, const Vec3& b) { return (a - b).norm() < same_place; };
    outline_.erase(std::unique(outline_.begin(), outline_.end(), same), outline_.end());
    while (outline_.size() > 1 && same(outline_.front(), outline_.back())) outline_.pop_back();
    if (outline_.size() < 3)
      throw InputError(fmt::format("{}: slice {}: an outline of {} point{}; expected 3 or more",
                                   stack_.source, in_quotes(slice.name), outline_.size(),
                                   outline_.size() == 1 ? "" : "s"));
    if (slice.outlines.size() >= most_outlines)
      throw InputError(fmt::format("{}: slice {}: expected at most {} outlines", stack_.source,
                                   in_quotes(slice.name), most_outlines));
    slice.outlines.push_back(std::move(outline_));
    outline_.clear();
  }

 private:
  const TableLines& lines_;
  ContourStack& stack_;
  std::set<std::string> seen_;
  std::vector<Vec3> outline_;
  std::string contour_;
  double first_point_ = 0, last_point_ = 0;
  size_t in_slice_ = 0, in_all_ = 0;
};

}  // namespace

ContourStack read_contour_stack(const std::string& path) {
  TableLines lines(path);
  std::string line = lines.first_filled();
  const char separator = separator_of(line);
  const auto header = fields_of(line, separator);
  const auto column = stack_columns(header, lines);
  TableNumbers numbers(separator);
  ContourStack stack{{}, path};
  StackRows rows(lines, stack);
  while (lines.next_filled(line)) {
    const auto fields = fields_of(line, separator);
    if (fields.size() != header.size())
      lines.fail(other_count(fields.size(), "the header", header.size(), line));
    const auto number = [&](StackColumn k) {
      const std::string& field = fields[column[k]];
      const double value = number_of_column(column_names[k], field, numbers, lines);
      if (std::abs(value) > farthest_mm)
        lines.fail(fmt::format("column {}: {} is out of all range", column_names[k],
                               in_quotes(trimmed(field))));
      return value;
    };
    const bool several = column[col_contour] < header.size();
    const std::string slice = trimmed(fields[column[col_slice]]);
    const std::string contour = several ? trimmed(fields[column[col_contour]]) : "";
    if (slice.empty()) lines.fail("column slice: is empty; expected the slice's number");
    if (several && contour.empty()) lines.fail("column contour: is empty; expected its number");
    rows.add(slice, contour, number(col_point),
             stack_mm * Vec3(number(col_x), number(col_y), number(col_z)));
  }
  rows.finish_outline();
  if (stack.slices.size() < 2)
    throw InputError(fmt::format("{}: {} slice{}; expected 2 or more", path, stack.slices.size(),
                                 stack.slices.size() == 1 ? "" : "s"));
  return stack;
}

}  // namespace genio
