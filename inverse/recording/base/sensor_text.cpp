#include "inverse/recording/base/sensor_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

namespace genio {
namespace {

constexpr size_t shown = 40;  // characters of a field in a message

bool marks_missing(const std::string& field) {
  static constexpr std::array marks = {"",    "*",   "NA",  "NaN",  "nan", "NAN",
                                       "N/A", "Inf", "inf", "-Inf", "-inf"};
  return std::find(marks.begin(), marks.end(), field) != marks.end();
}

/// With a point for its only comma.
std::string with_point(std::string field) {
  const auto comma = field.find(',');
  if (comma != std::string::npos && field.find('.') == std::string::npos) field[comma] = '.';
  return field;
}

std::string bare(const std::string& field) {
  std::string text = trimmed(field);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = trimmed(text.substr(1, text.size() - 2));
  return text;
}

}  // namespace

std::vector<std::string> sensor_fields(const std::string& line) {
  std::vector<std::string> fields;
  const std::string text = trimmed(line);
  if (text.empty()) return fields;
  char separator = 0;
  for (const char c : {'\t', ';', ' ', ','})
    if (separator == 0 && text.find(c) != std::string::npos) separator = c;
  if (separator == ' ') {
    std::istringstream words(text);
    for (std::string word; words >> word;) fields.push_back(bare(word));
    return fields;
  }
  // A first field may be empty, as a table's row numbers have no title.
  for (const auto& field : split_fields(line, separator == 0 ? '\t' : separator))
    fields.push_back(bare(field));
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

bool is_value(const std::string& field) {
  double value = 0;
  return marks_missing(field) || parse_number(with_point(field), value);
}

double SensorNumbers::operator()(const std::string& field, const TableLines& lines) {
  if (marks_missing(field)) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  if (!parse_number(with_point(field), value))
    lines.fail(fmt::format("'{}': expected a number", field.substr(0, shown)));
  commas_ = commas_ || field.find(',') != std::string::npos;
  points_ = points_ || field.find('.') != std::string::npos;
  if (commas_ && points_)
    lines.fail(fmt::format("'{}': the table has decimal commas and decimal points",
                           field.substr(0, shown)));
  return value;
}

}  // namespace genio
