#pragma once
#include <random>
#include <string>
#include <vector>

#include "server/udpm/parts.hpp"

namespace genio::test {

/// A message of random bytes that are the same for the same seed.
inline WholeMessage sample_message(size_t size, unsigned seed = 1,
                                   const std::string& channel = "SAMPLE") {
  std::mt19937 random(seed);
  WholeMessage message{channel, std::vector<uint8_t>(size)};
  for (uint8_t& byte : message.bytes) byte = uint8_t(random());
  return message;
}

/// All its parts in order.
inline std::vector<part_t> parts_of(const WholeMessage& message, int64_t utime = 1) {
  const size_t capacity = part_capacity(message.channel, UdpmLimits{}.datagram_bytes);
  const std::string digest = message_digest(message.channel, message.bytes);
  std::vector<part_t> parts{cut_part(message, digest, utime, capacity, 0)};
  while (parts.size() < size_t(parts[0].count))
    parts.push_back(cut_part(message, digest, utime, capacity, parts.size()));
  return parts;
}

}  // namespace genio::test
