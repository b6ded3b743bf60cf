#include "inverse/recording/base/unicode_text.hpp"

#include <cstdint>

#include "inverse/recording/base/unicode.hpp"

namespace genio {
namespace {

uint32_t byte_at(const std::string& bytes, size_t i) { return uint8_t(bytes[i]); }

std::string from_utf16(const std::string& bytes, bool big_first) {
  constexpr uint32_t unknown = 0xFFFD;
  const auto unit = [&](size_t i) {
    const uint32_t a = byte_at(bytes, i), b = byte_at(bytes, i + 1);
    return big_first ? a << 8 | b : b << 8 | a;
  };
  std::string text;
  for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
    uint32_t code = unit(i);
    if (code >= 0xD800 && code < 0xE000) {  // half of a pair
      const uint32_t low = code < 0xDC00 && i + 3 < bytes.size() ? unit(i + 2) : 0;
      const bool paired = low >= 0xDC00 && low < 0xE000;
      code = paired ? 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00) : unknown;
      if (paired) i += 2;
    }
    if (i > 1 || code != 0xFEFF) append_utf8(text, char32_t(code));
  }
  return text;
}

}  // namespace

std::string utf8_of(const std::string& bytes) {
  const std::string mark = bytes.substr(0, 2);
  if (mark == "\xFE\xFF" || (mark.size() == 2 && mark[0] == '\0' && mark[1] != '\0'))
    return from_utf16(bytes, true);
  if (mark == "\xFF\xFE" || (mark.size() == 2 && mark[0] != '\0' && mark[1] == '\0'))
    return from_utf16(bytes, false);
  if (bytes.starts_with("\xEF\xBB\xBF")) return bytes.substr(3);
  return is_utf8(bytes) ? bytes : utf8_of_latin1(bytes);
}

}  // namespace genio
