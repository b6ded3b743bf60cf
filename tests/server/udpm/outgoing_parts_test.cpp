#include "server/udpm/outgoing_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/server/udpm/sample_parts.hpp"

namespace genio {
namespace {

using std::chrono::seconds;
using test::parts_of;
using test::sample_message;

class Outgoing : public testing::Test {
 protected:
  /// Sends all that waits.
  std::vector<part_t> send() {
    std::vector<part_t> sent;
    while (const auto part = outgoing.next()) sent.push_back(*part), outgoing.sent(now);
    return sent;
  }
  void ask(std::vector<int32_t> indices, const WholeMessage& of) {
    part_ask_t ask{};
    ask.message = message_digest(of.channel, of.bytes);
    ask.index = std::move(indices), ask.count = int32_t(ask.index.size());
    outgoing.resend(ask, now);
  }
  static std::vector<int32_t> indices(const std::vector<part_t>& parts) {
    std::vector<int32_t> result;
    for (const part_t& p : parts) result.push_back(p.index);
    return result;
  }
  UdpmTime now{std::chrono::hours(1)};
  const UdpmLimits limits{.kept_bytes = 50000, .kept_messages = 3};
  UdpmCounts counts;
  OutgoingParts outgoing{limits, counts};
  const WholeMessage message = sample_message(10000);
};

TEST_F(Outgoing, EveryPartIsSentOnceInOrder) {
  ASSERT_TRUE(outgoing.add(message, 5, now));
  EXPECT_EQ(indices(send()), (std::vector<int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_FALSE(outgoing.any_wait());
}

TEST_F(Outgoing, WhatIsAskedForIsSentAgain) {
  outgoing.add(message, 5, now), send();
  ask({3, 5, 5}, message);
  const auto again = send();
  EXPECT_EQ(indices(again), (std::vector<int32_t>{3, 5}));
  EXPECT_EQ(again[0].utime, 5);
  EXPECT_EQ(again[0].data, parts_of(message)[3].data);
}

TEST_F(Outgoing, AnAskOfAnyContentDoesNoHarm) {
  outgoing.add(message, 5, now), send();
  ask({-1, 8, INT32_MAX, INT32_MIN}, message);
  ask({0, 1}, sample_message(10000, 2));
  EXPECT_FALSE(outgoing.any_wait());
}

TEST_F(Outgoing, WhatStillWaitsIsNotSentTwice) {
  outgoing.add(message, 5, now);
  ask({0, 1, 7}, message);
  outgoing.add(message, 6, now);
  const auto sent = send();
  EXPECT_EQ(sent.size(), 8u);
  EXPECT_EQ(sent[0].utime, 6);
}

// An ask is small and a part is large: strangers shall not make a sender send without end.
TEST_F(Outgoing, APartIsSentSixteenTimesAtMostUntilItIsPublishedAgain) {
  outgoing.add(message, 5, now), send();
  size_t sent = 0;
  for (int k = 0; k < 100; ++k) ask({2}, message), sent += send().size();
  EXPECT_EQ(sent, 15u);
  outgoing.add(message, 6, now), send();
  ask({2}, message);
  EXPECT_EQ(send().size(), 1u);
}

TEST_F(Outgoing, WhoHasFewestPartsLeftGoesFirst) {
  const auto small = sample_message(2000, 2);
  outgoing.add(message, 1, now);
  outgoing.sent(now);
  outgoing.add(small, 2, now);
  const auto sent = send();
  EXPECT_EQ(sent[0].data, parts_of(small)[0].data);
  EXPECT_EQ(sent[1].data, parts_of(small)[1].data);
  EXPECT_EQ(sent.size(), 9u);
}

TEST_F(Outgoing, WhatWasSentMakesRoomAndWhatWaitsDoesNot) {
  for (unsigned k = 0; k < 3; ++k) EXPECT_TRUE(outgoing.add(sample_message(10000, k), k, now));
  EXPECT_FALSE(outgoing.add(sample_message(10000, 3), 3, now));
  send();
  EXPECT_TRUE(outgoing.add(sample_message(10000, 3), 4, now));
  EXPECT_EQ(outgoing.kept_messages(), 3u);
  ask({0}, sample_message(10000, 0));  // the oldest was forgotten
  EXPECT_EQ(send().size(), 8u);
  EXPECT_FALSE(outgoing.add(sample_message(60000, 4), 5, now));
  EXPECT_LE(outgoing.kept_bytes(), limits.kept_bytes);
}

TEST_F(Outgoing, WhatWasSentIsForgottenAfterSomeTime) {
  outgoing.add(message, 5, now), send();
  now += seconds(9), outgoing.forget_old(now);
  ask({0}, message);
  EXPECT_EQ(send().size(), 1u);
  now += seconds(11), outgoing.forget_old(now);
  EXPECT_EQ(outgoing.kept_bytes(), 0u);
  ask({0}, message);
  EXPECT_FALSE(outgoing.any_wait());
}

}  // namespace
}  // namespace genio
