#pragma once
// Text from outside, in a form that harms neither a terminal nor a reader of lines.

#include <cstdint>
#include <string>
#include <string_view>

namespace genio {

/// ISO 8601 in UTC with `digits` of the second's fraction, 3 or 6; "-" for 0, which is no time.
/// Times outside the years 0 to 9999 are given as their number.
std::string utc_text(int64_t us_since_1970, int digits);

/// Bytes that a terminal or a reader might take amiss as \xNN: controls, what is no UTF-8, and
/// signs that turn the direction of writing; the backslash as two.
std::string escaped_text(const std::string& bytes);

/// The beginning, at most `most` bytes, that ends with a whole sign where the text is UTF-8.
std::string_view cut_text(std::string_view text, size_t most);

}  // namespace genio
