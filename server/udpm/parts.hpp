#pragma once
// Messages that are too long for one datagram, in parts.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/udpm/limits.hpp"
#include "server/wire/wire.hpp"

namespace genio {

inline constexpr const char* part_channel = "GENIO_PART";
inline constexpr const char* part_ask_channel = "GENIO_PART_ASK";

/// A message of any length.
struct WholeMessage {
  std::string channel;
  std::vector<uint8_t> bytes;
};

/// What part_t::message is of it: 32 hexadecimal digits.
std::string message_digest(std::string_view channel, std::span<const uint8_t> bytes);

/// Bytes of a message on that channel which one part carries in a datagram.
size_t part_capacity(std::string_view channel, size_t largest_datagram);

/// Numbers of missing parts that one ask carries in a datagram.
size_t ask_capacity(size_t largest_datagram);

/// Part `index` of a message that is cut into pieces of `capacity` bytes. `digest`: its own.
part_t cut_part(const WholeMessage& message, const std::string& digest, int64_t utime,
                size_t capacity, size_t index);

}  // namespace genio
