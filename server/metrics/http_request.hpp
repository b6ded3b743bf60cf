#pragma once
// The little of HTTP that a scraper of metrics speaks.

#include <cstddef>
#include <string>
#include <string_view>

namespace genio {

inline constexpr size_t longest_http_request = 8192;  ///< bytes, headers included

/// What is to be said to what came so far.
enum class HttpAnswer {
  not_yet,         ///< the headers have not ended
  metrics,         ///< 200
  malformed,       ///< 400
  other_host,      ///< 403: asked by a name that is not this host's
  unknown_path,    ///< 404
  unknown_method,  ///< 405
  too_long,        ///< 431
};

struct HttpVerdict {
  HttpAnswer answer;
  bool head = false;  ///< the headers of the response alone
};

/// Judges the beginning of a connection. The header Host must name this host by 127.x.y.z or
/// localhost where it is there: a page in a browser may only read what answers to its own name,
/// and this does not, whatever addresses that name is given.
HttpVerdict judge_http(std::string_view received);

/// The response, which ends the connection. `metrics`: the text; without it 503.
std::string http_response(const HttpVerdict& verdict, const std::string* metrics);

}  // namespace genio
