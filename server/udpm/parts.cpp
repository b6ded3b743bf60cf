#include "server/udpm/parts.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <array>

#include "server/udpm/datagram.hpp"

namespace genio {
namespace {

constexpr size_t digest_bytes = 16;  // of the 32 that SHA-256 has

}  // namespace

std::string message_digest(std::string_view channel, std::span<const uint8_t> bytes) {
  crypto_hash_sha256_state state;
  const uint8_t zero = 0;
  std::array<uint8_t, crypto_hash_sha256_BYTES> digest{};
  crypto_hash_sha256_init(&state);
  crypto_hash_sha256_update(&state, reinterpret_cast<const uint8_t*>(channel.data()),
                            channel.size());
  crypto_hash_sha256_update(&state, &zero, 1);
  crypto_hash_sha256_update(&state, bytes.data(), bytes.size());
  crypto_hash_sha256_final(&state, digest.data());
  return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + digest_bytes, ""));
}

size_t part_capacity(std::string_view channel, size_t largest_datagram) {
  part_t empty{};
  empty.channel = channel, empty.message = std::string(2 * digest_bytes, '0');
  return largest_datagram - datagram_bytes(part_channel, size_t(empty.getEncodedSize()));
}

size_t ask_capacity(size_t largest_datagram) {
  part_ask_t empty{};
  empty.message = std::string(2 * digest_bytes, '0');
  const size_t taken = datagram_bytes(part_ask_channel, size_t(empty.getEncodedSize()));
  return (largest_datagram - taken) / sizeof(int32_t);
}

part_t cut_part(const WholeMessage& message, const std::string& digest, int64_t utime,
                size_t capacity, size_t index) {
  const std::vector<uint8_t>& bytes = message.bytes;
  const size_t begin = index * capacity, end = std::min(begin + capacity, bytes.size());
  part_t part{};
  part.utime = utime, part.channel = message.channel, part.message = digest;
  part.index = int32_t(index), part.count = int32_t((bytes.size() + capacity - 1) / capacity);
  part.data.assign(bytes.begin() + ptrdiff_t(begin), bytes.begin() + ptrdiff_t(end));
  part.size = int32_t(part.data.size());
  return part;
}

}  // namespace genio
