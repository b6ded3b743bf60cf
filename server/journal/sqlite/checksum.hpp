#pragma once
// SQLite finds damage of its structure, but not of what it stores.

#include <cstdint>
#include <span>
#include <string>

namespace genio {

/// FNV-1a of 64 bits over values one after another: every change of a single byte changes it.
class Checksum {
 public:
  Checksum& add(std::span<const uint8_t> bytes) {
    add(int64_t(bytes.size()));
    for (const uint8_t byte : bytes) add_byte(byte);
    return *this;
  }
  Checksum& add(const std::string& text) {
    return add({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  }
  Checksum& add(int64_t value) {
    for (int k = 0; k < 64; k += 8) add_byte(uint8_t(uint64_t(value) >> k));
    return *this;
  }
  int64_t value() const { return int64_t(hash_); }

 private:
  void add_byte(uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }

  uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace genio
