#pragma once
// LCM's short messages, one a datagram, as lcm_udpm.c of LCM 1.3 has them: the mark LC02, a number
// that counts the sender's datagrams, both of 32 bits with the high byte first, the channel with a
// zero byte, and the payload.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "server/udpm/counts.hpp"

namespace genio {

inline constexpr size_t udpm_header_bytes = 8;
inline constexpr size_t udpm_longest_channel = 63;  ///< as LCM has it, without the zero byte
inline constexpr size_t udpm_largest_datagram = 65507;

/// A datagram that was read; valid as long as its bytes.
struct UdpmDatagram {
  std::string_view channel;
  std::span<const uint8_t> payload;
};

/// Reads a datagram of any bytes. Nothing where it is no short message of LCM; `why` says what it
/// is then.
std::optional<UdpmDatagram> read_datagram(std::span<const uint8_t> bytes, UdpmDrop& why);

/// `number`: of the sender's datagrams.
std::vector<uint8_t> make_datagram(uint32_t number, std::string_view channel,
                                   std::span<const uint8_t> payload);

/// Size of the datagram that make_datagram makes.
size_t datagram_bytes(std::string_view channel, size_t payload_bytes);

}  // namespace genio
