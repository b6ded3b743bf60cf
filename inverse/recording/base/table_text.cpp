#include "inverse/recording/base/table_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace genio {

TableLines::TableLines(const std::string& path) : path_(path), in_(path) {
  if (!in_) throw InputError(path + ": no such file");
}

bool TableLines::next(std::string& line) {
  if (!std::getline(in_, line)) return false;
  if (++number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

void TableLines::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_, number_, what));
}

std::vector<std::string> split_fields(const std::string& line, char separator) {
  std::vector<std::string> fields(1);
  for (char c : line)
    if (c == separator) fields.emplace_back();
    else fields.back() += c;
  return fields;
}

std::string trimmed(const std::string& field) {
  const auto first = field.find_first_not_of(" \t\"");
  if (first == std::string::npos) return {};
  return field.substr(first, field.find_last_not_of(" \t\"") - first + 1);
}

bool parse_number(const std::string& field, double& value) {
  const std::string text = trimmed(field);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace genio
