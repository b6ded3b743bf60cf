#include "server/seal/seal.hpp"

#include <gtest/gtest.h>
#include <sodium.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "tests/server/seal/sample_key.hpp"

namespace genio {
namespace {

using test::sample_key;

constexpr int64_t sealed_at = 1'800'000'000'123'456, window = 30'000'000;
const std::string seal_channel = "GENIO_ACK";

SealNonce sample_nonce() {
  SealNonce nonce;
  std::iota(nonce.begin(), nonce.end(), uint8_t(100));
  return nonce;
}

std::vector<uint8_t> sealed_sample(const std::vector<uint8_t>& body = {'b', 'o', 'd', 'y'}) {
  return seal(*sample_key(), seal_channel, body, sealed_at, sample_nonce());
}

OpenedSeal opened(const std::vector<uint8_t>& bytes, int64_t now = sealed_at,
                  const std::string& channel = seal_channel) {
  return open_seal(*sample_key(), channel, bytes.data(), bytes.size(), now, window);
}

std::string hex_of(const std::vector<uint8_t>& bytes) {
  std::string hex(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(hex.data(), hex.size(), bytes.data(), bytes.size());
  hex.pop_back();
  return hex;
}

TEST(Seal, GivesBackWhatItHolds) {
  for (const std::vector<uint8_t>& body :
       {std::vector<uint8_t>{}, {0}, std::vector<uint8_t>(max_message_bytes, 7)}) {
    const auto bytes = sealed_sample(body);
    EXPECT_TRUE(looks_sealed(bytes.data(), bytes.size()));
    const OpenedSeal o = opened(bytes);
    ASSERT_EQ(o.fault, SealFault::none) << body.size();
    EXPECT_EQ(o.message.body, body);
    EXPECT_EQ(o.message.utime, sealed_at);
    EXPECT_TRUE(std::ranges::equal(o.message.nonce, sample_nonce()));
  }
}

// Python's hashlib.blake2b made it of the bytes as docs/threat-model.md lays them out.
TEST(Seal, IsThatOfTheLayoutInTheDocumentation) {
  EXPECT_EQ(hex_of(sealed_sample()),
            "fe11e72441b4c73300066517289a62406465666768696a6b6c6d6e6f70717273"
            "0000000a47454e494f5f41434b0000000004626f6479"
            "ce03480c7057cbb4ae596d9bf2f4d029ae561625dd5a2a7f83c32c1c01986f2f");
}

TEST(Seal, EachFlippedBitIsRefused) {
  const auto good = sealed_sample();
  ASSERT_EQ(opened(good).fault, SealFault::none);
  for (size_t bit = 0; bit < 8 * good.size(); ++bit) {
    auto bytes = good;
    bytes[bit / 8] ^= uint8_t(1u << bit % 8);
    // Without its fingerprint it is no sealed message at all.
    EXPECT_EQ(opened(bytes).fault, bit < 64 ? SealFault::unsealed : SealFault::forged) << bit;
  }
}

TEST(Seal, EachTruncationAndTrailingByteIsRefused) {
  auto bytes = sealed_sample();
  for (size_t n = 0; n < bytes.size(); ++n)
    EXPECT_NE(open_seal(*sample_key(), seal_channel, bytes.data(), n, sealed_at, window).fault,
              SealFault::none)
        << n;
  bytes.push_back(0);
  EXPECT_EQ(opened(bytes).fault, SealFault::forged);
}

TEST(Seal, AnotherChannelIsRefused) {
  for (const char* channel : {"GENIO_CANCEL", "GENIO_AC", "GENIO_ACKS", ""})
    EXPECT_EQ(opened(sealed_sample(), sealed_at, channel).fault, SealFault::forged) << channel;
}

TEST(Seal, AnotherKeyIsRefused) {
  const auto bytes = sealed_sample();
  EXPECT_EQ(
      open_seal(*sample_key(1), seal_channel, bytes.data(), bytes.size(), sealed_at, window).fault,
      SealFault::forged);
}

TEST(Seal, OneThatIsTooOldOrTooFarAheadIsRefused) {
  const auto bytes = sealed_sample();
  for (const int64_t off : {-window, window})
    EXPECT_EQ(opened(bytes, sealed_at + off).fault, SealFault::none) << off;
  for (const int64_t off : {-window - 1, window + 1})
    EXPECT_EQ(opened(bytes, sealed_at + off).fault, SealFault::stale) << off;
  // No time is too far off to be compared.
  for (const int64_t utime :
       {std::numeric_limits<int64_t>::min(), int64_t(0), std::numeric_limits<int64_t>::max()})
    EXPECT_EQ(opened(seal(*sample_key(), seal_channel, {}, utime, sample_nonce())).fault,
              SealFault::stale)
        << utime;
}

TEST(Seal, AMessageWithoutOneIsTold) {
  const auto plain = encode(ack_t{});
  EXPECT_EQ(opened(plain).fault, SealFault::unsealed);
  EXPECT_FALSE(looks_sealed(plain.data(), plain.size()));
  EXPECT_EQ(opened({}).fault, SealFault::unsealed);
  EXPECT_EQ(opened({1, 2, 3}).fault, SealFault::unsealed);
}

TEST(Seal, OneThatIsTooLargeIsRefused) {
  EXPECT_EQ(opened(sealed_sample(std::vector<uint8_t>(max_message_bytes + 1))).fault,
            SealFault::forged);
  EXPECT_EQ(opened(sealed_sample(std::vector<uint8_t>(2 * max_message_bytes))).fault,
            SealFault::forged);
}

TEST(Seal, WhoHasTheKeyMayNotSendWhatDoesNotDecode) {
  const auto good = sealed_sample();
  const size_t size_at = 8 + 8 + nonce_bytes + 4 + seal_channel.size() + 1;
  for (const uint32_t claim : {0u, 3u, 5u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
    auto bytes = good;
    for (size_t k = 0; k < 4; ++k) bytes[size_at + k] = uint8_t(claim >> (24 - 8 * k));
    // As whoever has the key can make it.
    std::string hashed = "genio.sealed_t.1" + std::string(bytes.begin(), bytes.end() - 32);
    crypto_generichash(&bytes[bytes.size() - 32], 32,
                       reinterpret_cast<const uint8_t*>(hashed.data()), hashed.size(),
                       sample_key()->secret().data(), seal_key_bytes);
    EXPECT_EQ(opened(bytes).fault, SealFault::forged) << claim;
  }
}

TEST(Seal, NoncesAreNotRepeated) {
  std::set<SealNonce> nonces;
  for (int k = 0; k < 1000; ++k) nonces.insert(new_nonce());
  EXPECT_EQ(nonces.size(), 1000u);
}

}  // namespace
}  // namespace genio
