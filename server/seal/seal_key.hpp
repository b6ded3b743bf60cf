#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace genio {

inline constexpr size_t seal_key_bytes = 32;

/// The secret that a server shares with those who may ask. It is wiped from memory at its end.
class SealKey {
 public:
  explicit SealKey(std::span<const uint8_t, seal_key_bytes> secret);
  ~SealKey();
  SealKey(const SealKey&) = delete;
  SealKey& operator=(const SealKey&) = delete;

  std::span<const uint8_t, seal_key_bytes> secret() const { return secret_; }

 private:
  std::array<uint8_t, seal_key_bytes> secret_;
};

/// Null: no key.
using SharedKey = std::shared_ptr<const SealKey>;

/// Reads a file of one line with 64 hexadecimal digits. Throws InputError naming the file where it
/// holds anything else, or where others than its owner may read or write it, or where its owner is
/// neither this process's user nor root.
SharedKey read_key_file(const std::string& path);

/// Makes such a file with a key at random, which only its owner may read and write. Throws
/// InputError naming the file where it is there already or cannot be written.
void make_key_file(const std::string& path);

}  // namespace genio
