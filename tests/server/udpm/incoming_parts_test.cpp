#include "server/udpm/incoming_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/server/udpm/sample_parts.hpp"

namespace genio {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::parts_of;
using test::sample_message;

class Incoming : public testing::Test {
 protected:
  /// The messages that become whole.
  std::vector<WholeMessage> take(const std::vector<part_t>& coming, uint64_t source = 1) {
    std::vector<WholeMessage> whole;
    for (const part_t& part : coming)
      if (auto complete = incoming.take(part, source, now)) whole.push_back(std::move(*complete));
    return whole;
  }
  /// Those that are asked for now.
  std::vector<int32_t> asked() {
    const auto ask = incoming.ask(now);
    return ask ? ask->index : std::vector<int32_t>{};
  }
  UdpmTime now{std::chrono::hours(1)};
  UdpmLimits limits{.unfinished_bytes = 100000, .unfinished_messages = 8, .finished_messages = 4};
  UdpmCounts counts;
  IncomingParts incoming{limits, counts,
                         [](std::string_view c) { return c.starts_with("SAMPLE"); }};
  const WholeMessage message = sample_message(10000);
  const std::vector<part_t> parts = parts_of(message);
};

TEST_F(Incoming, PartsMayComeInAnyOrder) {
  std::mt19937 random(1);
  for (int64_t k = 1; k <= 100; ++k) {
    auto shuffled = parts_of(message, k);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    const auto whole = take(shuffled);
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(whole[0].channel, message.channel);
    EXPECT_EQ(whole[0].bytes, message.bytes);
  }
  EXPECT_EQ(incoming.held_bytes(), 0u);
}

TEST_F(Incoming, PartsThatComeTwiceCountOnce) {
  auto twice = parts;
  twice.insert(twice.begin(), parts.begin(), parts.end() - 1);
  twice.insert(twice.end(), parts.begin(), parts.end());  // after the whole
  EXPECT_EQ(take(twice).size(), 1u);
  EXPECT_EQ(incoming.unfinished(), 0u);
}

TEST_F(Incoming, AMessagePublishedAgainFillsWhatIsMissing) {
  auto again = parts_of(message, 2);
  EXPECT_TRUE(take({parts.begin() + 1, parts.end()}).empty());
  EXPECT_EQ(take({again[0]}).size(), 1u);
  // The rest of that publication is no message of its own.
  EXPECT_TRUE(take({again.begin() + 1, again.end()}).empty());
  EXPECT_EQ(incoming.unfinished(), 0u);
}

// A client whose reply was lost publishes its request again, which must reach the server again.
TEST_F(Incoming, AMessagePublishedAgainAfterItCameComesAgain) {
  EXPECT_EQ(take(parts_of(message, 1)).size(), 1u);
  EXPECT_EQ(take(parts_of(message, 2)).size(), 1u);
}

TEST_F(Incoming, LatePartsAreKnownForSomeTime) {
  take(parts);
  now += seconds(9), incoming.forget_old(now);
  EXPECT_TRUE(take(parts).empty());
  EXPECT_EQ(counts.repeated_parts, parts.size());
  EXPECT_EQ(incoming.unfinished(), 0u);
}

TEST_F(Incoming, MissingPartsAreAskedForOnceNothingComes) {
  take({parts[0], parts[2], parts[3]});
  EXPECT_TRUE(asked().empty());
  EXPECT_EQ(incoming.next_due(), now + limits.first_ask);
  now += limits.first_ask;
  EXPECT_EQ(asked(), (std::vector<int32_t>{1, 4, 5, 6, 7}));
  EXPECT_TRUE(asked().empty());
  take({parts[1]});
  EXPECT_EQ(incoming.next_due(), now + limits.first_ask);
}

TEST_F(Incoming, WhoIsNotAnsweredAsksLessAndLessOftenAndGivesUp) {
  take({parts[0]});
  int asks = 0;
  const UdpmTime end = now + seconds(60);
  for (; now < end; now += milliseconds(1)) {
    incoming.forget_old(now);
    asks += !asked().empty();
  }
  EXPECT_GT(asks, 8);
  EXPECT_LT(asks, 20);
  EXPECT_EQ(incoming.held_bytes(), 0u);
  EXPECT_EQ(counts.abandoned, 1u);
  EXPECT_FALSE(incoming.next_due());
}

TEST_F(Incoming, AskNamesNoMoreThanADatagramHolds) {
  auto far = parts[0];
  far.count = 8192;
  IncomingParts roomy(UdpmLimits{}, counts, [](std::string_view) { return true; });
  roomy.take(far, 1, now);
  EXPECT_EQ(roomy.ask(now + limits.first_ask)->index.size(), ask_capacity(1400));
}

TEST_F(Incoming, WhatNobodyWantsTakesNothing) {
  EXPECT_TRUE(take(parts_of(sample_message(10000, 1, "OTHER"))).empty());
  EXPECT_EQ(incoming.unfinished(), 0u);
}

TEST_F(Incoming, PartsThatCannotBeAreDropped) {
  const auto with = [&](auto change) {
    part_t part = parts[0];
    change(part);
    return part;
  };
  const std::vector<part_t> wrong = {
      with([](part_t& p) { p.index = -1; }),
      with([](part_t& p) { p.index = p.count; }),
      with([](part_t& p) { p.count = 0; }),
      with([](part_t& p) { p.count = -1; }),
      with([](part_t& p) { p.count = 8193; }),
      with([](part_t& p) { p.index = p.count = INT32_MAX; }),
      with([](part_t& p) { p.data.clear(), p.size = 0; }),
      with([](part_t& p) { p.channel = "SAMPLE" + std::string(60, 'c'); }),
      with([](part_t& p) { p.message = "short"; }),
      with([](part_t& p) { p.message.clear(); })};
  EXPECT_TRUE(take(wrong).empty());
  EXPECT_EQ(counts.dropped(UdpmDrop::bad_part), wrong.size());
  EXPECT_EQ(incoming.held_bytes(), 0u);
  EXPECT_EQ(take(parts).size(), 1u);
}

TEST_F(Incoming, ChangedBytesAreTakenOrDropped) {
  std::mt19937 random(1);
  size_t decoded = 0;
  for (int k = 0; k < 20000; ++k) {
    auto bytes = encode(parts[random() % parts.size()]);
    for (unsigned flips = 1 + random() % 4; flips > 0; --flips)
      bytes[random() % (k % 2 ? 100 : bytes.size())] ^= uint8_t(1u << random() % 8);
    if (random() % 8 == 0) bytes.resize(random() % bytes.size());
    std::string why;
    auto part = decode_checked<part_t>(bytes.data(), bytes.size(), why);
    if (!part) continue;
    ++decoded;
    const auto whole = incoming.take(std::move(*part), random() % 3, now);
    EXPECT_TRUE(!whole || whole->bytes == message.bytes);
    now += milliseconds(1);
    while (incoming.ask(now)) {
    }
    ASSERT_LE(incoming.held_bytes(), limits.unfinished_bytes);
  }
  EXPECT_GT(decoded, 1000u);
}

TEST_F(Incoming, PartsThatDisagreeDoNotSpoilTheMessage) {
  part_t other_count = parts[1], other_channel = parts[1], other_data = parts[0];
  other_count.count = 3, other_channel.channel = "SAMPLE2", other_data.data[0] ^= 1;
  take({parts[0], other_count, other_channel, other_data});
  const auto whole = take({parts.begin() + 1, parts.end()});
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].bytes, message.bytes);
}

TEST_F(Incoming, AForgedPartCostsOneMoreRound) {
  part_t forged = parts[0];
  forged.data[0] ^= 1;
  take({forged});
  EXPECT_TRUE(take(parts).empty());
  EXPECT_EQ(counts.wrong_digests, 1u);
  now += limits.first_ask;
  EXPECT_EQ(asked().size(), parts.size());
  EXPECT_EQ(take(parts).size(), 1u);
}

TEST_F(Incoming, AMessageAboveTheLimitIsNeverHeld) {
  limits.message_bytes = 5000;
  IncomingParts small(limits, counts, [](std::string_view) { return true; });
  for (const part_t& part : parts) EXPECT_FALSE(small.take(part, 1, now));
  EXPECT_LE(small.held_bytes(), 5000 + 1000u);
}

TEST_F(Incoming, JunkOfManySendersTakesNoMoreThanTheLimits) {
  std::mt19937 random(1);
  size_t most = 0;
  for (unsigned k = 0; k < 3000; ++k) {
    auto junk = parts_of(sample_message(5000 + random() % 3000, k))[random() % 4];
    if (random() % 2) junk.count = int32_t(random() % 8192);
    incoming.take(junk, random() % 100, now);
    now += std::chrono::microseconds(10);
    most = std::max(most, incoming.held_bytes());
    ASSERT_LE(incoming.unfinished(), limits.unfinished_messages);
  }
  EXPECT_LE(most, limits.unfinished_bytes);
  EXPECT_GT(counts.evicted, 1000u);
}

TEST_F(Incoming, OneSenderDoesNotPushOutAnother) {
  take({parts.begin() + 1, parts.end()}, 1);
  for (unsigned k = 2; k < 1000; ++k) {
    now += milliseconds(1);
    take({parts_of(sample_message(10000, k))[0]}, 2);
  }
  EXPECT_EQ(take({parts[0]}, 1).size(), 1u);
}

TEST_F(Incoming, TheOldestOfAllGoesFirst) {
  for (unsigned k = 0; k < 20; ++k) {
    now += milliseconds(1);
    take({parts_of(sample_message(2000, k))[0]}, k);
  }
  EXPECT_TRUE(take({parts_of(sample_message(2000, 0))[1]}, 0).empty());
  EXPECT_EQ(take({parts_of(sample_message(2000, 19))[1]}, 19).size(), 1u);
}

}  // namespace
}  // namespace genio
