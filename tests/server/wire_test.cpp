#include "server/wire/wire.hpp"

#include <gtest/gtest.h>

#include <random>

namespace genio {
namespace {

shape_request_t sample_request() {
  shape_request_t r{};
  r.id = "a", r.client = "c", r.point_count = 2;
  r.x_mm = {1, 2}, r.y_mm = {0, 0}, r.z_mm = {3, 4}, r.sigma_mm = {0, 0}, r.kind = {"curve", "tip"};
  return r;
}

TEST(Wire, RoundTripKeepsEverything) {
  const auto bytes = encode(sample_request());
  std::string why;
  const auto r = decode_checked<shape_request_t>(bytes.data(), bytes.size(), why);
  ASSERT_TRUE(r) << why;
  EXPECT_EQ(r->kind[1], "tip");
  EXPECT_EQ(r->z_mm[1], 4);
}

TEST(Wire, EveryTruncationAndTrailingByteIsRefused) {
  auto bytes = encode(sample_request());
  std::string why;
  for (size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_FALSE(decode_checked<shape_request_t>(bytes.data(), n, why)) << n;
    EXPECT_FALSE(why.empty());
  }
  bytes.push_back(0);
  EXPECT_FALSE(decode_checked<shape_request_t>(bytes.data(), bytes.size(), why));
}

TEST(Wire, ClaimedLengthsAreNotBelieved) {
  const auto good = encode(sample_request());
  // fingerprint, utime, id, client; model, stream, label; time, priority; prior, frame; placement
  const size_t count_at = 8 + 8 + 2 * (4 + 2) + 3 * (4 + 1) + 8 + 4 + 2 * (4 + 1) + 6 * 8;
  std::string why;
  for (uint32_t claim : {0x20000000u, 0x7fffffffu, 0xffffffffu, 0x80000000u, 3u, 1u}) {
    auto bytes = good;
    for (int i = 0; i < 4; ++i) bytes[count_at + size_t(i)] = uint8_t(claim >> (24 - 8 * i));
    EXPECT_FALSE(decode_checked<shape_request_t>(bytes.data(), bytes.size(), why)) << claim;
  }
}

TEST(Wire, AZeroByteInsideAStringIsRefusedSinceNoReaderOfLcmSeesWhatFollows) {
  for (const size_t at : {0, 1, 2}) {
    shape_request_t r = sample_request();
    r.id = "abc", r.kind = {"abc", "abc"};
    auto bytes = encode(r);
    std::string why;
    ASSERT_TRUE(decode_checked<shape_request_t>(bytes.data(), bytes.size(), why));
    bytes[8 + 8 + 4 + at] = 0;  // fingerprint, time, length of the id
    EXPECT_FALSE(decode_checked<shape_request_t>(bytes.data(), bytes.size(), why));
    EXPECT_NE(why.find("zero byte"), why.npos) << why;
  }
}

TEST(Wire, RandomDamageNeverCrashes) {
  const auto good = encode(sample_request());
  std::mt19937 bits(1);
  std::string why;
  for (int i = 0; i < 20000; ++i) {
    auto bytes = good;
    for (int k = 0; k < 3; ++k) bytes[8 + bits() % (bytes.size() - 8)] = uint8_t(bits());
    decode_checked<shape_request_t>(bytes.data(), bytes.size(), why);
  }
}

TEST(Wire, OtherTypesAreRecognised) {
  cancel_t c{};
  const auto bytes = encode(c);
  std::string why;
  EXPECT_FALSE(decode_checked<shape_request_t>(bytes.data(), bytes.size(), why));
  EXPECT_NE(why.find("fingerprint"), std::string::npos);
}

}  // namespace
}  // namespace genio
