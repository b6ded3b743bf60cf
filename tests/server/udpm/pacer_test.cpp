#include "server/udpm/pacer.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const UdpmTime pacer_start{std::chrono::hours(1)};

/// Bytes that go within a time, in pieces.
size_t sent_within(Pacer& pacer, UdpmTime from, UdpmClock::duration time, size_t piece) {
  size_t sent = 0;
  for (UdpmTime now = from; now <= from + time; now += std::chrono::microseconds(100))
    while (pacer.is_free(now)) pacer.spend(piece, now), sent += piece;
  return sent;
}

TEST(Pacer, SendsSoMuchASecondAndABurst) {
  Pacer pacer(1e6, 20000);
  EXPECT_NEAR(double(sent_within(pacer, pacer_start, seconds(2), 1400)), 2.02e6, 1500);
}

TEST(Pacer, APauseEarnsOneBurstOnly) {
  Pacer pacer(1e6, 20000);
  sent_within(pacer, pacer_start, milliseconds(10), 1400);
  EXPECT_NEAR(double(sent_within(pacer, pacer_start + seconds(100), milliseconds(0), 1400)), 20000,
              1500);
}

TEST(Pacer, TellsWhenItIsFree) {
  Pacer pacer(1e6, 20000);
  EXPECT_EQ(pacer.free_at(pacer_start), pacer_start);
  pacer.spend(30000, pacer_start);
  const UdpmTime free = pacer.free_at(pacer_start);
  EXPECT_FALSE(pacer.is_free(free - milliseconds(1)));
  EXPECT_TRUE(pacer.is_free(free));
}

TEST(Pacer, WhatGoesAnywayHoldsOthersUpForABurstAtMost) {
  Pacer pacer(1e6, 20000);
  for (int k = 0; k < 1000; ++k) pacer.spend(1400, pacer_start);
  EXPECT_TRUE(pacer.is_free(pacer_start + milliseconds(21)));
}

TEST(Pacer, AClockThatStandsStillEarnsNothing) {
  Pacer pacer(1e6, 20000);
  pacer.spend(30000, pacer_start);
  EXPECT_FALSE(pacer.is_free(pacer_start - seconds(10)));
  EXPECT_FALSE(pacer.is_free(pacer_start));
}

}  // namespace
}  // namespace genio
