#include "server/seal/key_refusals.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

constexpr int64_t asked_at = 1'800'000'000'000'000;

std::vector<uint8_t> plain_request() {
  shape_request_t r{};
  r.id = "a", r.client = "me";
  return encode(r);
}

SealLimits three_then_one_a_second() {
  SealLimits limits;
  limits.answers = 3, limits.answers_per_s = 1;
  return limits;
}

TEST(KeyRefusals, WhoHasNoKeyIsToldSo) {
  KeyRefusals refusals{SealLimits{}};
  cancel_t cancel{};
  cancel.id = "a", cancel.client = "me";
  for (const auto& bytes : {plain_request(), encode(cancel)}) {
    const auto answers = refusals.answer(bytes.data(), bytes.size(), asked_at);
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0].channel, "GENIO_REPLY.me");
    std::string why;
    const auto reply =
        decode_checked<command_reply_t>(answers[0].bytes.data(), answers[0].bytes.size(), why);
    ASSERT_TRUE(reply) << why;
    EXPECT_EQ(reply->id, "a");
    EXPECT_EQ(reply->status, "refused");
    EXPECT_NE(reply->message.find("--key"), std::string::npos) << reply->message;
  }
}

TEST(KeyRefusals, AFloodIsNotAnswered) {
  KeyRefusals refusals(three_then_one_a_second());
  const auto bytes = plain_request();
  const auto told = [&](int64_t now) {
    size_t count = 0;
    for (int k = 0; k < 100; ++k) count += refusals.answer(bytes.data(), bytes.size(), now).size();
    return count;
  };
  EXPECT_EQ(told(asked_at), 3u);
  EXPECT_EQ(told(asked_at + 999'999), 0u);
  EXPECT_EQ(told(asked_at + 2'500'000), 2u);
  EXPECT_EQ(told(asked_at + 3600'000'000), 3u);
  EXPECT_EQ(told(asked_at), 0u);  // a clock that was set back brings nothing
}

TEST(KeyRefusals, NobodyIsToldWhereNobodyIsNamed) {
  KeyRefusals refusals{SealLimits{}};
  for (const auto& bytes : {std::vector<uint8_t>{}, {1, 2, 3}, std::vector<uint8_t>(1000, 0xff)})
    EXPECT_TRUE(refusals.answer(bytes.data(), bytes.size(), asked_at).empty());
}

TEST(KeyRefusals, AnOlderClientIsToldInATypeThatItKnows) {
  KeyRefusals refusals{SealLimits{}};
  auto bytes = plain_request();
  const uint64_t hash = 0x95a7b6730632514f, fingerprint = hash << 1 | hash >> 63;
  for (size_t k = 0; k < 8; ++k) bytes[k] = uint8_t(fingerprint >> (56 - 8 * k));
  const auto answers = refusals.answer(bytes.data(), bytes.size(), asked_at);
  ASSERT_EQ(answers.size(), 1u);
  std::string why;
  EXPECT_FALSE(
      decode_checked<command_reply_t>(answers[0].bytes.data(), answers[0].bytes.size(), why));
  EXPECT_NE(why.find("fingerprint"), std::string::npos);
}

}  // namespace
}  // namespace genio
