#include "server/seal/seal.hpp"

#include <sodium.h>

#include <algorithm>

namespace genio {
namespace {

constexpr size_t mac_bytes = sizeof(sealed_t::mac);
using SealMac = std::array<uint8_t, mac_bytes>;

/// Before the message: what is hashed for another purpose under the same key is no seal.
constexpr char seal_domain[] = "genio.sealed_t.1";

/// Of all bytes of an encoded sealed_t before its mac. They hold their own lengths, so that two
/// messages never have the same bytes.
SealMac mac_of(const SealKey& key, std::span<const uint8_t> bytes) {
  SealMac mac;
  crypto_generichash_state state;
  crypto_generichash_init(&state, key.secret().data(), key.secret().size(), mac.size());
  crypto_generichash_update(&state, reinterpret_cast<const uint8_t*>(seal_domain),
                            sizeof seal_domain - 1);
  crypto_generichash_update(&state, bytes.data(), bytes.size());
  crypto_generichash_final(&state, mac.data(), mac.size());
  sodium_memzero(&state, sizeof state);
  return mac;
}

}  // namespace

SealNonce new_nonce() {
  SealNonce nonce;
  randombytes_buf(nonce.data(), nonce.size());
  return nonce;
}

std::vector<uint8_t> seal(const SealKey& key, const std::string& channel,
                          std::span<const uint8_t> body, int64_t utime, const SealNonce& nonce) {
  sealed_t message{};
  message.utime = utime, message.channel = channel;
  std::copy(nonce.begin(), nonce.end(), message.nonce);
  message.body.assign(body.begin(), body.end());
  message.size = int(body.size());
  std::vector<uint8_t> bytes = encode(message);
  const size_t before = bytes.size() - mac_bytes;
  const SealMac mac = mac_of(key, std::span(bytes).first(before));
  std::copy(mac.begin(), mac.end(), bytes.begin() + ptrdiff_t(before));
  return bytes;
}

OpenedSeal open_seal(const SealKey& key, const std::string& channel, const void* data, size_t size,
                     int64_t now, int64_t window_us) {
  OpenedSeal opened;
  if (!looks_sealed(data, size)) return opened;
  opened.fault = SealFault::forged;
  if (size > most_bytes<sealed_t> || size < mac_bytes) return opened;
  const auto* const bytes = static_cast<const uint8_t*>(data);
  const size_t before = size - mac_bytes;
  const SealMac mac = mac_of(key, {bytes, before});
  if (sodium_memcmp(mac.data(), bytes + before, mac_bytes) != 0) return opened;
  std::string why;
  auto message = decode_checked<sealed_t>(data, size, why);
  if (!message || message->channel != channel) return opened;
  opened.message = std::move(*message);
  const int64_t utime = opened.message.utime;
  const bool fresh = utime >= now - window_us && utime <= now + window_us;
  opened.fault = fresh ? SealFault::none : SealFault::stale;
  return opened;
}

bool looks_sealed(const void* data, size_t size) {
  if (size < 8) return false;
  uint64_t fingerprint = 0;
  for (size_t k = 0; k < 8; ++k)
    fingerprint = fingerprint << 8 | static_cast<const uint8_t*>(data)[k];
  return fingerprint == uint64_t(sealed_t::getHash());
}

}  // namespace genio
