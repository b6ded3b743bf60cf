#include "runs/text/csv_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace genio {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(double number, int digits) {
  return std::isnan(number) ? "" : fmt::format("{:.{}g}", number, digits);
}

std::string csv_number(const std::map<std::string, double>& by_name, const std::string& name,
                       int digits) {
  const auto it = by_name.find(name);
  return it == by_name.end() ? "" : csv_number(it->second, digits);
}

}  // namespace genio
