#include "server/seal/seen_seals.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

constexpr int64_t seconds = 1'000'000, start = 1'800'000'000 * seconds;

SealNonce nonce_of(uint8_t number) {
  SealNonce nonce{};
  nonce[0] = number;
  return nonce;
}

/// A memory for few seals, with the usual window of 30 s.
SealLimits few(size_t remembered = 4) {
  SealLimits limits;
  limits.remembered = remembered;
  return limits;
}

TEST(SeenSeals, EachIsTakenOnce) {
  SeenSeals seen(few(), start);
  EXPECT_TRUE(seen.take(start, nonce_of(1), start));
  EXPECT_FALSE(seen.take(start, nonce_of(1), start));
  EXPECT_TRUE(seen.take(start, nonce_of(2), start));
  EXPECT_TRUE(seen.take(start + 1, nonce_of(1), start));
  EXPECT_FALSE(seen.take(start, nonce_of(2), start + 30 * seconds));
}

TEST(SeenSeals, OldOnesAreForgottenAndYetNotTakenAgain) {
  SeenSeals seen(few(), start);
  ASSERT_TRUE(seen.take(start, nonce_of(1), start));
  const int64_t later = start + 31 * seconds;
  EXPECT_TRUE(seen.take(later, nonce_of(2), later));
  EXPECT_EQ(seen.size(), 1u);
  // Not even where the clock was set back a little meanwhile.
  EXPECT_FALSE(seen.take(start, nonce_of(1), later - 10 * seconds));
}

TEST(SeenSeals, AFullMemoryForgetsTheOldestAndTakesNothingAsOld) {
  SeenSeals seen(few(4), start);
  for (int k = 0; k < 100; ++k) {
    EXPECT_TRUE(seen.take(start + k, nonce_of(uint8_t(k)), start)) << k;
    EXPECT_LE(seen.size(), 4u);
  }
  for (int k = 0; k < 100; ++k)
    EXPECT_FALSE(seen.take(start + k, nonce_of(uint8_t(k)), start)) << k;
  // Of those that never came, the older ones are refused and the newer ones taken.
  EXPECT_FALSE(seen.take(start + 95, nonce_of(200), start));
  EXPECT_TRUE(seen.take(start + 98, nonce_of(200), start));
}

TEST(SeenSeals, AFullMemoryTakesALateOneOnce) {
  SeenSeals seen(few(2), start);
  ASSERT_TRUE(seen.take(start + 10, nonce_of(1), start));
  ASSERT_TRUE(seen.take(start + 11, nonce_of(2), start));
  EXPECT_TRUE(seen.take(start + 5, nonce_of(3), start));
  EXPECT_FALSE(seen.take(start + 5, nonce_of(3), start));
}

TEST(SeenSeals, WhatWasSealedForAnEarlierServerIsNotTaken) {
  SeenSeals seen(few(), start);
  EXPECT_FALSE(seen.take(start - 2 * seconds, nonce_of(1), start));
  // Clocks of two hosts differ a little.
  EXPECT_TRUE(seen.take(start - seconds / 2, nonce_of(1), start));
}

TEST(SeenSeals, AClockThatIsSetBackShutsNobodyOut) {
  SeenSeals seen(few(), start);
  ASSERT_TRUE(seen.take(start, nonce_of(1), start));
  const int64_t earlier = start - 3600 * seconds;
  EXPECT_TRUE(seen.take(earlier, nonce_of(2), earlier));
  EXPECT_FALSE(seen.take(earlier, nonce_of(2), earlier));
  // What was taken before is still known when the clock comes there again.
  EXPECT_FALSE(seen.take(start, nonce_of(1), start));
}

}  // namespace
}  // namespace genio
