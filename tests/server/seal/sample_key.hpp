#pragma once
#include <array>
#include <memory>
#include <numeric>

#include "server/seal/seal_key.hpp"

namespace genio::test {

/// Bytes that count up from `first`.
inline SharedKey sample_key(uint8_t first = 0) {
  std::array<uint8_t, seal_key_bytes> secret;
  std::iota(secret.begin(), secret.end(), first);
  return std::make_shared<const SealKey>(secret);
}

}  // namespace genio::test
