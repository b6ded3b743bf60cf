#include "inverse/recording/base/unicode_text.hpp"

#include <cstdint>

namespace genio {
namespace {

void append(std::string& text, uint32_t code) {
  const auto put = [&](uint32_t byte) { text += char(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) put(0xC0 | code >> 6);
  else if (code < 0x10000) put(0xE0 | code >> 12), put(0x80 | (code >> 6 & 0x3F));
  else put(0xF0 | code >> 18), put(0x80 | (code >> 12 & 0x3F)), put(0x80 | (code >> 6 & 0x3F));
  put(0x80 | (code & 0x3F));
}

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
    if (i > 1 || code != 0xFEFF) append(text, code);
  }
  return text;
}

/// Length of the UTF-8 character at `i`; 0 where there is none.
size_t character(const std::string& bytes, size_t i) {
  const uint32_t first = byte_at(bytes, i);
  const size_t size = first < 0x80                    ? 1
                      : first >= 0xC2 && first < 0xE0 ? 2
                      : first >= 0xE0 && first < 0xF0 ? 3
                      : first >= 0xF0 && first < 0xF5 ? 4
                                                      : 0;
  if (size == 0 || i + size > bytes.size()) return 0;
  for (size_t k = 1; k < size; ++k)
    if ((byte_at(bytes, i + k) & 0xC0) != 0x80) return 0;
  return size;
}

bool is_utf8(const std::string& bytes) {
  for (size_t i = 0; i < bytes.size();)
    if (const size_t size = character(bytes, i)) i += size;
    else return false;
  return true;
}

}  // namespace

std::string utf8_of(const std::string& bytes) {
  const std::string mark = bytes.substr(0, 2);
  if (mark == "\xFE\xFF" || (mark.size() == 2 && mark[0] == '\0' && mark[1] != '\0'))
    return from_utf16(bytes, true);
  if (mark == "\xFF\xFE" || (mark.size() == 2 && mark[0] != '\0' && mark[1] == '\0'))
    return from_utf16(bytes, false);
  if (bytes.starts_with("\xEF\xBB\xBF")) return bytes.substr(3);
  if (is_utf8(bytes)) return bytes;
  std::string text;
  for (size_t i = 0; i < bytes.size(); ++i) append(text, byte_at(bytes, i));
  return text;
}

}  // namespace genio
