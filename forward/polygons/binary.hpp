#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace genio {

/// The value whose bytes stand at `at`; they must be there.
template <class T>
T binary_value(std::string_view bytes, size_t at, bool big_endian) {
  char raw[sizeof(T)];
  std::memcpy(raw, bytes.data() + at, sizeof raw);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof raw);
  T value;
  std::memcpy(&value, raw, sizeof value);
  return value;
}

}  // namespace genio
