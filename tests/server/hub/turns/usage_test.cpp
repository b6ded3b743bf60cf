#include "server/hub/turns/usage.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

using std::chrono::milliseconds;

const HubTime begin{std::chrono::hours(1)};

TEST(HubUsage, HalvesEverySecond) {
  HubUsage usage(begin);
  const double newcomer = usage.at(begin);
  EXPECT_GT(newcomer, 0);
  usage.add(8e-3, false, begin);
  EXPECT_NEAR(usage.at(begin), newcomer + 8e-3, 1e-9);
  EXPECT_NEAR(usage.at(begin + milliseconds(1000)), (newcomer + 8e-3) / 2, 1e-9);
  usage.add(1e-3, false, begin + milliseconds(2000));
  EXPECT_NEAR(usage.at(begin + milliseconds(3000)), (newcomer + 8e-3) / 8 + 5e-4, 1e-9);
}

TEST(HubUsage, IsMuchOnlyWhereItsTurnsWereTooShortForIt) {
  HubUsage busy(begin), floods(begin);
  busy.add(1, false, begin);
  floods.add(1e-6, true, begin);
  EXPECT_FALSE(busy.is_much(begin, false));
  EXPECT_TRUE(floods.is_much(begin, false));
  EXPECT_FALSE(floods.is_much(begin + milliseconds(1001), true));
}

TEST(HubUsage, OneLongMessageNowAndThenIsNotMuch) {
  HubUsage usage(begin);
  const HubTime later = begin + milliseconds(10000);
  usage.add(1e-3, true, later);
  EXPECT_FALSE(usage.is_much(later, false));
}

TEST(HubUsage, WhatIsMuchRemainsSoUntilItIsClearlyLess) {
  HubUsage usage(begin);
  const HubTime later = begin + milliseconds(1500);  // 5 ms have become less than 2
  usage.add(0, true, later);
  EXPECT_FALSE(usage.is_much(later, false));
  EXPECT_TRUE(usage.is_much(later, true));
  EXPECT_FALSE(usage.is_much(later + milliseconds(900), true));
}

}  // namespace
}  // namespace genio
