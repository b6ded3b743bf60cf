#include "server/metrics/http_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace genio {
namespace {

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(uint8_t(x)) == std::tolower(uint8_t(y));
  });
}

/// The text before `end`, which is taken off with it; all where it does not occur.
std::string_view take_until(std::string_view& text, std::string_view end) {
  const size_t at = text.find(end);
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at == text.npos ? text.size() : at + end.size());
  return taken;
}

std::string_view without_blanks(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == text.npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool names_this_host(std::string_view host) {
  const std::string_view name = host.substr(0, host.find(':'));
  if (same_word(name, "localhost")) return true;
  return name.starts_with("127.") && name.find_first_not_of("0123456789.") == name.npos;
}

/// Headers after the first line; false where one has no name.
bool read_headers(std::string_view headers, std::optional<std::string_view>& host) {
  while (!headers.empty()) {
    std::string_view value = take_until(headers, "\r\n");
    if (value.find(':') == value.npos) return false;
    const std::string_view name = take_until(value, ":");
    if (!same_word(name, "host")) continue;
    if (host) return false;
    host = without_blanks(value);
  }
  return true;
}

struct HttpStatus {
  const char* line;
  const char* body;
};

HttpStatus status_of(HttpAnswer answer) {
  switch (answer) {
    case HttpAnswer::metrics:
      return {"503 Service Unavailable", "The service does not run yet.\n"};
    case HttpAnswer::other_host:
      return {"403 Forbidden", "This port answers to 127.0.0.1 and localhost alone.\n"};
    case HttpAnswer::unknown_path:
      return {"404 Not Found", "There is nothing here but /metrics.\n"};
    case HttpAnswer::unknown_method:
      return {"405 Method Not Allowed", "Only GET and HEAD are understood.\n"};
    case HttpAnswer::too_long:
      return {"431 Request Header Fields Too Large", "The request is too long.\n"};
    default:
      return {"400 Bad Request", "This is no request of HTTP/1.\n"};
  }
}

}  // namespace

HttpVerdict judge_http(std::string_view received) {
  const size_t end = received.find("\r\n\r\n");
  if (end == received.npos || end + 4 > longest_http_request)
    return {received.size() < longest_http_request ? HttpAnswer::not_yet : HttpAnswer::too_long};
  std::string_view headers = received.substr(0, end);
  std::string_view line = take_until(headers, "\r\n");
  const std::string_view method = take_until(line, " ");
  std::string_view target = take_until(line, " ");
  if (method.empty() || !target.starts_with('/') || !(line == "HTTP/1.1" || line == "HTTP/1.0"))
    return {HttpAnswer::malformed};
  const bool head = method == "HEAD";
  std::optional<std::string_view> host;
  if (!read_headers(headers, host)) return {HttpAnswer::malformed, head};
  if (host && !names_this_host(*host)) return {HttpAnswer::other_host, head};
  if (method != "GET" && !head) return {HttpAnswer::unknown_method};
  if (take_until(target, "?") != "/metrics") return {HttpAnswer::unknown_path, head};
  return {HttpAnswer::metrics, head};
}

std::string http_response(const HttpVerdict& verdict, const std::string* metrics) {
  HttpStatus status = status_of(verdict.answer);
  std::string_view body = status.body, type = "", allow = "";
  if (verdict.answer == HttpAnswer::unknown_method) allow = "Allow: GET, HEAD\r\n";
  if (verdict.answer == HttpAnswer::metrics && metrics)
    status.line = "200 OK", body = *metrics, type = " version=0.0.4;";
  return fmt::format(
      "HTTP/1.1 {}\r\nContent-Type: text/plain;{} charset=utf-8\r\nContent-Length: {}\r\n"
      "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n{}Connection: close\r\n\r\n{}",
      status.line, type, body.size(), allow, verdict.head ? "" : body);
}

}  // namespace genio
