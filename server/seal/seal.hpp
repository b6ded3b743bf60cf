#pragma once
// Sealed messages as bytes: docs/threat-model.md has the layout.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "server/seal/seal_key.hpp"
#include "server/wire/wire.hpp"

namespace genio {

inline constexpr size_t nonce_bytes = 16;
using SealNonce = std::array<uint8_t, nonce_bytes>;

/// At random: no two are alike.
SealNonce new_nonce();

/// A sealed_t for the channel, encoded. `utime` [us since 1970]. A pair of time and nonce is used
/// once.
std::vector<uint8_t> seal(const SealKey& key, const std::string& channel,
                          std::span<const uint8_t> body, int64_t utime, const SealNonce& nonce);

/// What is wrong with a message where a seal is asked for.
enum class SealFault {
  none,
  unsealed,  ///< no sealed_t
  forged,    ///< its seal is wrong: of another key, of another channel, or the message was changed
  stale,     ///< sealed too long ago, or too far ahead
};

struct OpenedSeal {
  SealFault fault = SealFault::unsealed;
  sealed_t message{};  ///< where the fault is none or stale
};

/// Opens what came on the channel at the time `now`; nothing of a message is decoded before its
/// seal is found right. `window_us`: by which its time may differ from now. Whether it came before
/// is SeenSeals' to say.
OpenedSeal open_seal(const SealKey& key, const std::string& channel, const void* data, size_t size,
                     int64_t now, int64_t window_us);

/// True for what begins as a sealed message, whatever its seal is worth.
bool looks_sealed(const void* data, size_t size);

}  // namespace genio
