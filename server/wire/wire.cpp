#include "server/wire/wire.hpp"

#include <chrono>
#include <cstring>

namespace genio {

std::string scan_layout(const uint8_t* data, size_t size, const char* fields) {
  size_t at = 0;
  int32_t count = 0;
  const auto read_int = [&](int32_t& v) {
    if (size - at < 4) return false;
    v = int32_t(uint32_t(data[at]) << 24 | uint32_t(data[at + 1]) << 16 |
                uint32_t(data[at + 2]) << 8 | uint32_t(data[at + 3]));
    at += 4;
    return true;
  };
  const auto skip = [&](size_t n) { return size - at >= n && (at += n, true); };
  const auto skip_string = [&] {
    int32_t length = 0;
    if (!read_int(length) || length < 1 || length > max_string_length + 1 ||
        size_t(length) > size - at)
      return false;
    // LCM's strings end at their first zero byte, so that what follows would be lost.
    const void* const end = std::memchr(data + at, 0, size_t(length));
    at += size_t(length);
    return end == data + at - 1;
  };
  for (const char* f = fields; *f; ++f) {
    bool good = true;
    switch (*f) {
      case 'l':
      case 'd':
        good = skip(8);
        break;
      case 'i':
        good = skip(4);
        break;
      case 'b':
        good = skip(1);
        break;
      case 's':
        good = skip_string();
        break;
      case 'n':
      case 'm': {
        const int most = *f == 'n' ? max_array_length : int(max_message_bytes);
        good = read_int(count);
        if (good && (count < 0 || count > most))
          return "an array claims " + std::to_string(count) + " entries; expected 0 to " +
                 std::to_string(most);
        break;
      }
      case 'B':
        good = skip(size_t(count));
        break;
      case 'I':
        good = skip(4 * size_t(count));
        break;
      case 'D':
        good = skip(8 * size_t(count));
        break;
      case 'S':
        for (int32_t i = 0; i < count && good; ++i) good = skip_string();
        break;
      default:
        return "unknown layout";
    }
    if (!good)
      return "the message ends early, a length in it is wrong, or a string has a zero byte inside";
  }
  return at == size ? "" : "there are bytes after the end of the message";
}

int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace genio
