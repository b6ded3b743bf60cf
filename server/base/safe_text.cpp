#include "server/base/safe_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace genio {
namespace {

/// Bytes of the UTF-8 sign that begins at `at`, and its number; 0 where none does.
size_t utf8_sign(const std::string& text, size_t at, uint32_t& sign) {
  const auto byte = [&](size_t k) { return uint32_t(uint8_t(text[at + k])); };
  const uint32_t first = byte(0);
  const size_t length = first < 0x80       ? 1
                        : first >> 5 == 6  ? 2
                        : first >> 4 == 14 ? 3
                        : first >> 3 == 30 ? 4
                                           : 0;
  if (length == 0 || at + length > text.size()) return 0;
  sign = length == 1 ? first : first & (0x7fu >> length);
  for (size_t k = 1; k < length; ++k) {
    if (byte(k) >> 6 != 2) return 0;
    sign = sign << 6 | (byte(k) & 0x3f);
  }
  constexpr uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = sign >= 0xd800 && sign < 0xe000;
  return sign < smallest[length] || surrogate || sign > 0x10ffff ? 0 : length;
}

bool shown_as_it_is(uint32_t sign) {
  const bool control = sign < 0x20 || (sign >= 0x7f && sign < 0xa0);
  const bool steers = (sign >= 0x200b && sign <= 0x200f) || (sign >= 0x2028 && sign <= 0x202e) ||
                      (sign >= 0x2060 && sign <= 0x206f) || sign == 0xfeff;
  return !control && !steers;
}

}  // namespace

std::string utc_text(int64_t us_since_1970, int digits) {
  using namespace std::chrono;
  constexpr int64_t first = -62'167'219'200'000'000, end = 253'402'300'800'000'000;
  if (us_since_1970 == 0) return "-";
  if (us_since_1970 < first || us_since_1970 >= end) return fmt::format("{} us", us_since_1970);
  const sys_time<microseconds> time{microseconds(us_since_1970)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  const int64_t fraction = clock.subseconds().count();
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:0{}}Z", int(date.year()),
                     unsigned(date.month()), unsigned(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(),
                     digits == 3 ? fraction / 1000 : fraction, digits);
}

std::string escaped_text(const std::string& bytes) {
  std::string text;
  for (size_t at = 0; at < bytes.size();) {
    uint32_t sign = 0;
    const size_t length = utf8_sign(bytes, at, sign);
    if (sign == '\\' && length == 1) text += "\\\\";
    else if (length > 0 && shown_as_it_is(sign)) text += bytes.substr(at, length);
    else
      for (size_t k = at; k < at + std::max<size_t>(length, 1); ++k)
        text += fmt::format("\\x{:02x}", uint8_t(bytes[k]));
    at += std::max<size_t>(length, 1);
  }
  return text;
}

std::string_view cut_text(std::string_view text, size_t most) {
  if (text.size() <= most) return text;
  constexpr size_t longest_sign = 4;
  size_t end = most;
  while (end > 0 && most - end < longest_sign - 1 && uint8_t(text[end]) >> 6 == 2) --end;
  return text.substr(0, end);
}

}  // namespace genio
