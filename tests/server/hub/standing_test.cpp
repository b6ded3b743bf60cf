#include "server/hub/standing.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

using std::chrono::milliseconds;

const HubTime start{std::chrono::hours(1)};

HubStanding standing(bool greeted, bool took_part, milliseconds active) {
  HubStanding s;
  s.greeted = greeted, s.took_part = took_part;
  s.accepted = start, s.active = start + active;
  return s;
}

TEST(HubDue, NobodyIsDueWhoGreetedAndOwesNothing) {
  EXPECT_FALSE(hub_due(standing(true, false, milliseconds(0)), HubLimits{}));
}

TEST(HubDue, EveryDebtHasItsTimeAndTheFirstCounts) {
  HubLimits limits;
  limits.greeting = milliseconds(100), limits.partial = milliseconds(200),
  limits.draining = milliseconds(300);
  HubStanding s = standing(false, false, milliseconds(0));
  auto due = hub_due(s, limits);
  ASSERT_TRUE(due);
  EXPECT_EQ(due->at, start + milliseconds(100));
  EXPECT_EQ(due->why, HubDrop::not_greeted);
  s.greeted = true;
  s.backlog_bytes = 1, s.drained = start + milliseconds(50);
  due = hub_due(s, limits);
  ASSERT_TRUE(due);
  EXPECT_EQ(due->at, start + milliseconds(350));
  EXPECT_EQ(due->why, HubDrop::slow_reader);
  s.partial = true, s.partial_grew = start + milliseconds(50);
  due = hub_due(s, limits);
  ASSERT_TRUE(due);
  EXPECT_EQ(due->at, start + milliseconds(250));
  EXPECT_EQ(due->why, HubDrop::stalled);
}

TEST(LessUseful, FirstWithoutGreetingThenWithoutPartThenTheBusiestThenTheIdlest) {
  const HubTime now = start + milliseconds(1000);
  const HubStanding silent = standing(false, false, milliseconds(900));
  const HubStanding greeted = standing(true, false, milliseconds(800));
  HubStanding floods = standing(true, true, milliseconds(999));
  floods.uses_much = true;
  const HubStanding idle = standing(true, true, milliseconds(100));
  const HubStanding busy = standing(true, true, milliseconds(700));
  HubStanding service = standing(true, true, milliseconds(0));
  service.favoured = true;
  const HubStanding* order[] = {&silent, &greeted, &floods, &idle, &busy, &service};
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      EXPECT_EQ(less_useful(*order[a], *order[b], now), a < b) << a << ' ' << b;
}

TEST(LessUseful, WhoLeftMakesPlaceWhateverItDidBefore) {
  const HubTime now = start + milliseconds(1000);
  HubStanding left = standing(true, true, milliseconds(999));
  left.left = true;
  EXPECT_TRUE(less_useful(left, standing(true, false, milliseconds(0)), now));
  EXPECT_FALSE(less_useful(standing(true, false, milliseconds(0)), left, now));
}

TEST(LessUseful, ANewcomerHasTimeToGreet) {
  const HubStanding fresh = standing(false, false, milliseconds(0));
  const HubStanding idle = standing(true, false, milliseconds(-500));
  EXPECT_TRUE(less_useful(idle, fresh, start + milliseconds(50)));
  EXPECT_TRUE(less_useful(fresh, idle, start + milliseconds(150)));
}

TEST(PartialBurden, WhoHoldsMuchForLongWeighsMost) {
  HubStanding large = standing(true, true, milliseconds(0)), old = large, nothing = large;
  large.partial_bytes = 4 << 20, large.partial_began = start + milliseconds(995);
  old.partial_bytes = 256 << 10, old.partial_began = start;
  nothing.partial_began = start;
  const HubTime now = start + milliseconds(1000);
  EXPECT_GT(partial_burden(old, now), partial_burden(large, now));
  EXPECT_GT(partial_burden(large, now), 0);
  EXPECT_EQ(partial_burden(nothing, now), 0);
  large.partial_began = old.partial_began = now;
  EXPECT_GT(partial_burden(large, now), partial_burden(old, now));
}

}  // namespace
}  // namespace genio
