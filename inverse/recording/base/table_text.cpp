#include "inverse/recording/base/table_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "forward/base/input_file.hpp"
#include "inverse/recording/base/unicode.hpp"

namespace genio {
namespace {

constexpr size_t longest_line = size_t(4) << 20;  // bytes
constexpr size_t shown_length = 40;

/// The text with a point for its only comma, where that can be a decimal comma; else empty.
std::string with_decimal_point(const std::string& text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto comma = text.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == text.size() ||
      text.find_first_of(".,", comma + 1) != std::string::npos || text.find('.') < comma ||
      !digit(text[comma - 1]) || !digit(text[comma + 1]))
    return {};
  std::string result = text;
  result[comma] = '.';
  double value = 0;
  return parse_number(result, value) ? result : std::string();
}

/// As sensors' tables mark what is missing.
bool stands_for_nothing(const std::string& field) {
  const std::string text = lower_case(trimmed(field));
  return is_missing(text) || text == "inf" || text == "-inf";
}

}  // namespace

TableLines::TableLines(const std::string& path) : TablePlace(path) {
  check_input(path);
  in_.open(path, std::ios::binary);
  if (!in_) throw InputError(path + ": cannot be read");
  unsigned char mark[3] = {};
  in_.read(reinterpret_cast<char*>(mark), 3);
  const auto count = in_.gcount();
  in_.clear();
  size_t skipped = 0;
  if (count >= 2 && mark[0] == 0xFF && mark[1] == 0xFE)
    encoding_ = Encoding::utf16_little, skipped = 2;
  else if (count >= 2 && mark[0] == 0xFE && mark[1] == 0xFF)
    encoding_ = Encoding::utf16_big, skipped = 2;
  else if (count == 3 && mark[0] == 0xEF && mark[1] == 0xBB && mark[2] == 0xBF) skipped = 3;
  in_.seekg(std::streamoff(skipped));
}

int TableLines::unit() {
  using Traits = std::ifstream::traits_type;
  const int first = in_.rdbuf()->sbumpc();
  if (first == Traits::eof() || encoding_ == Encoding::bytes) return first;
  const int second = in_.rdbuf()->sbumpc();
  if (second == Traits::eof()) return second;
  return encoding_ == Encoding::utf16_little ? first + 256 * second : 256 * first + second;
}

int TableLines::character() {
  if (pushed_ != -2) return std::exchange(pushed_, -2);
  const int first = unit();
  if (encoding_ == Encoding::bytes || first < 0xD800 || first > 0xDFFF) return first;
  const int second = first < 0xDC00 ? unit() : -1;
  if (second < 0xDC00 || second > 0xDFFF) return 0xFFFD;  // half a pair stands for nothing
  return 0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00);
}

bool TableLines::next(std::string& line) {
  line.clear();
  int c = character();
  if (c < 0) return false;
  ++number_;
  for (; c >= 0 && c != '\n' && c != '\r'; c = character()) {
    if (c == 0)
      fail(
          "has a NUL byte: it is no text, or UTF-16 without its byte-order mark; save it as UTF-8");
    if (line.size() >= longest_line)
      fail(fmt::format("the line is longer than {} MB; expected a table with line ends",
                       longest_line >> 20));
    if (encoding_ == Encoding::bytes) line.push_back(char(c));
    else append_utf8(line, char32_t(c));
  }
  if (c == '\r')
    if (const int after = character(); after != '\n') pushed_ = after;
  if (encoding_ == Encoding::bytes && !is_utf8(line)) line = utf8_of_latin1(line);
  return true;
}

std::string TableLines::first_filled() {
  std::string line;
  if (!next_filled(line)) fail("the file is empty; expected a header line or numbers");
  return line;
}

bool TableLines::next_filled(std::string& line) {
  while (next(line))
    if (!trimmed(line).empty()) return true;
  return false;
}

void TablePlace::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_, std::max(1, number_), what));
}

std::vector<std::string> split_fields(const std::string& line, char separator) {
  std::vector<std::string> fields;
  const std::string closing = {'"', separator};
  bool may_close = true;  // false: no quote behind is closed
  for (size_t at = 0;;) {
    size_t end = line.find(separator, at);
    if (end != std::string::npos && line[at] == '"' && may_close) {
      size_t close = line.find(closing, at + 1);
      if (close == std::string::npos && line.size() > at + 1 && line.back() == '"')
        close = line.size() - 1;
      if (close == std::string::npos) may_close = false;
      else end = close + 1 < line.size() ? close + 1 : std::string::npos;
    }
    fields.push_back(line.substr(at, end == std::string::npos ? end : end - at));
    if (end == std::string::npos) return fields;
    at = end + 1;
  }
}

std::vector<std::string> split_at_blanks(const std::string& line) {
  std::vector<std::string> fields;
  for (size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string::npos;) {
    size_t end = line[at] == '"' ? line.find('"', at + 1) : std::string::npos;
    end = end == std::string::npos ? line.find_first_of(" \t", at) : end + 1;
    end = std::min(end, line.size());
    fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

char separator_of(const std::string& line) {
  for (char c : {'\t', ';', ','})
    if (line.find(c) != std::string::npos) return c;
  return ' ';
}

std::vector<std::string> fields_of(const std::string& line, char separator) {
  return separator == ' ' ? split_at_blanks(line) : split_fields(line, separator);
}

std::vector<std::string> sensor_fields(const std::string& line) {
  std::vector<std::string> fields;
  const std::string text = trimmed(line);
  if (text.empty()) return fields;
  char separator = 0;
  for (const char c : {'\t', ';', ' ', ','})
    if (separator == 0 && text.find(c) != std::string::npos) separator = c;
  // A first field may be empty, as a table's row numbers have no title.
  for (const auto& field :
       fields_of(separator == ' ' ? text : line, separator == 0 ? '\t' : separator))
    fields.push_back(trimmed(field));
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

std::string trimmed(const std::string& field) {
  const auto first = field.find_first_not_of(" \t\"");
  if (first == std::string::npos) return {};
  return field.substr(first, field.find_last_not_of(" \t\"") - first + 1);
}

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return text;
}

std::string in_quotes(const std::string& field) {
  std::string text = trimmed(field);
  size_t end = std::min(text.size(), shown_length);
  while (end < text.size() && end > 0 && (text[end] & 0xC0) == 0x80) --end;
  const bool cut = end < text.size();
  text.resize(end);
  for (char& c : text)
    if ((c >= 0 && c < ' ') || c == 127) c = '?';
  return fmt::format("'{}{}'", text, cut ? "..." : "");
}

bool is_missing(const std::string& field) {
  const std::string text = trimmed(field);
  if (text.size() > 4) return false;
  for (const char* mark : {"", "*", "na", "n/a", "#n/a", "nan", "none", "null"})
    if (lower_case(text) == mark) return true;
  return false;
}

bool parse_number(const std::string& field, double& value) {
  std::string text = trimmed(field);
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.erase(0, 1);
  double read = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(read))
    return false;
  value = read;
  return true;
}

bool TableNumbers::parse(const std::string& field, double& value) {
  if (parse_number(field, value)) {
    const bool point = field.find('.') != std::string::npos;
    if (point && commas_) return false;
    points_ = points_ || point;
    return true;
  }
  const std::string text = commas_allowed_ ? with_decimal_point(trimmed(field)) : std::string();
  if (text.empty() || points_) return false;
  commas_ = true;
  return parse_number(text, value);
}

bool is_value(const std::string& field) {
  double value = 0;
  return stands_for_nothing(field) || TableNumbers('\t').parse(field, value);
}

double TableNumbers::value(const std::string& field, const TablePlace& place) {
  double read = std::numeric_limits<double>::quiet_NaN();
  if (!stands_for_nothing(field) && !parse(field, read)) place.fail(complaint(field));
  return read;
}

std::string TableNumbers::complaint(const std::string& field) const {
  if (!with_decimal_point(trimmed(field)).empty())
    return fmt::format(
        "{}: a decimal comma? {}; expected decimal points", in_quotes(field),
        points_ ? "Numbers before it have decimal points" : "Commas stand between the fields here");
  if (trimmed(field).empty()) return "the field is empty";
  double value = 0;
  if (commas_ && parse_number(field, value))
    return fmt::format("{}: has a decimal point, and numbers before it have decimal commas",
                       in_quotes(field));
  return fmt::format("{} is not a finite number", in_quotes(field));
}

std::string other_count(size_t fields, const std::string& where, size_t expected,
                        const std::string& line) {
  const bool commas = fields > expected && line.find(',') != std::string::npos &&
                      line.find_first_of("\t;") == std::string::npos;
  return fmt::format("{} fields; the {} has {}{}", fields, where, expected,
                     commas              ? ". Decimal commas, or a comma in a text without quotes?"
                     : fields < expected ? ". Is the file cut short?"
                                         : "");
}

}  // namespace genio
