#include "inverse/recording/base/unicode.hpp"

#include <cstdint>

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

void append_utf8(std::string& text, char32_t c) {
  if (c < 0x80) {
    text += char(c);
  } else if (c < 0x800) {
    text += char(0xC0 | (c >> 6));
    text += char(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    text += char(0xE0 | (c >> 12));
    text += char(0x80 | ((c >> 6) & 0x3F));
    text += char(0x80 | (c & 0x3F));
  } else {
    text += char(0xF0 | (c >> 18));
    text += char(0x80 | ((c >> 12) & 0x3F));
    text += char(0x80 | ((c >> 6) & 0x3F));
    text += char(0x80 | (c & 0x3F));
  }
}

bool is_utf8(const std::string& text) {
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const size_t more = lead < 0x80                   ? 0
                        : lead >= 0xC2 && lead < 0xE0 ? 1
                        : lead >= 0xE0 && lead < 0xF0 ? 2
                        : lead >= 0xF0 && lead < 0xF5 ? 3
                                                      : 4;
    if (more == 4 || i + more >= text.size() + (more == 0 ? 1 : 0)) return false;
    char32_t c = more == 0 ? lead : lead & (0x3F >> more);
    for (size_t k = 1; k <= more; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xC0) != 0x80) return false;
      c = (c << 6) | (next & 0x3F);
    }
    if ((more == 2 && (c < 0x800 || (c >= 0xD800 && c < 0xE000))) ||
        (more == 3 && (c < 0x10000 || c > 0x10FFFF)))
      return false;
    i += more + 1;
  }
  return true;
}

std::string utf8_of_latin1(const std::string& text) {
  std::string result;
  for (const char c : text) append_utf8(result, static_cast<unsigned char>(c));
  return result;
}

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
