#include "server/log/log_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "server/base/safe_text.hpp"

namespace genio {
namespace {

using LineJson = nlohmann::ordered_json;

/// The same bound in both forms. Dots say that there was more.
std::string bounded(const std::string& text) {
  if (text.size() <= longest_logged) return text;
  return std::string(cut_text(text, longest_logged)) + "...";
}

/// Nobody reads more than six digits of a measured time in a log.
double six_digits(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr) : value;
}

bool needs_quotes(const std::string& text) {
  return text.empty() || std::any_of(text.begin(), text.end(),
                                     [](char c) { return c == ' ' || c == '"' || c == '='; });
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '\\';
    result += c;
  }
  return result + '"';
}

struct AsText {
  std::string operator()(const std::string& value) const {
    const std::string text = escaped_text(bounded(value));
    return needs_quotes(text) ? quoted(text) : text;
  }
  std::string operator()(int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{:.6g}", value); }
};

struct AsJson {
  LineJson operator()(const std::string& value) const { return bounded(value); }
  LineJson operator()(int64_t value) const { return value; }
  LineJson operator()(double value) const { return six_digits(value); }
};

}  // namespace

std::string log_line(const LogEvent& event, int64_t utime, LogForm form) {
  if (form == LogForm::text) {
    std::string line =
        fmt::format("{} {} {}", utc_text(utime, 3), name_of(event.level), name_of(event.kind));
    for (const LogField& f : event.fields)
      line += fmt::format(" {}={}", f.name, std::visit(AsText{}, f.value));
    return line + '\n';
  }
  LineJson json = {{"time", utc_text(utime, 3)},
                   {"level", name_of(event.level)},
                   {"event", name_of(event.kind)}};
  for (const LogField& f : event.fields) json[f.name] = std::visit(AsJson{}, f.value);
  return json.dump(-1, ' ', true, LineJson::error_handler_t::replace) + '\n';
}

}  // namespace genio
