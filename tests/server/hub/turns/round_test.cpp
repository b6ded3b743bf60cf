#include "server/hub/turns/round.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

const HubTime dawn{std::chrono::hours(1)};
const HubClock::duration none{0};

TEST(HubTurnKey, WhoUsedLeastIsNextUnlessAnotherHasWaitedLonger) {
  for (const bool more : {false, true}) {
    EXPECT_LT(HubTurnKey(more, 1e-3, none), HubTurnKey(more, 2e-3, none));
    EXPECT_LT(HubTurnKey(more, 2e-3, milliseconds(8)), HubTurnKey(more, 1e-3, none));
    // Whoever has waited for 60 ms goes before every newcomer, whatever it used.
    EXPECT_LT(HubTurnKey(more, 10, milliseconds(60)),
              HubTurnKey(more, HubUsage(dawn).at(dawn), none));
  }
}

TEST(HubTurnKey, WhoLeavesNothingUndoneGoesBeforeAllFloods) {
  EXPECT_LT(HubTurnKey(false, 10, none), HubTurnKey(true, 0, std::chrono::hours(1)));
  EXPECT_LT(HubTurnKey::first(), HubTurnKey(false, 0, std::chrono::hours(1)));
}

TEST(HubTurn, ManyShareSomeMillisecondsAndOneHasAllOfATurn) {
  const HubTurn most{microseconds(200), 128 << 10, 256 << 10};
  const HubTurn alone = turn_of_many(most, 1), nobody = turn_of_many(most, 0);
  for (const HubTurn& turn : {alone, nobody}) {
    EXPECT_EQ(turn.time, most.time);
    EXPECT_EQ(turn.read_bytes, most.read_bytes);
    EXPECT_EQ(turn.sent_bytes, most.sent_bytes);
  }
  const HubTurn of_hundred = turn_of_many(most, 100);
  EXPECT_EQ(of_hundred.time, microseconds(50));
  EXPECT_EQ(of_hundred.read_bytes, 32u << 10);
  EXPECT_EQ(of_hundred.sent_bytes, 64u << 10);
}

TEST(HubTurn, IsNeverTooShortToDoAnything) {
  const HubTurn turn = turn_of_many({microseconds(200), 128 << 10, 256 << 10}, 100000);
  EXPECT_GE(turn.time, microseconds(10));
  EXPECT_GE(turn.read_bytes, 4u << 10);
  EXPECT_GE(turn.sent_bytes, 4u << 10);
  // A limit that is smaller still holds.
  EXPECT_EQ(turn_of_many({microseconds(200), 100, 200}, 100000).read_bytes, 100u);
}

TEST(HubRound, EndsAndLeavesFloodsAPartOfIt) {
  const HubTurnKey light(false, 0, none), flood(true, 0, none);
  HubRound round(dawn, true);
  HubTime now = dawn;
  int lights = 0, floods = 0;
  for (; round.admits(light, now); now += microseconds(10)) ++lights;
  const HubTime middle = now;
  for (; round.admits(flood, now); now += microseconds(10)) ++floods;
  EXPECT_GT(lights, floods);
  EXPECT_GE(floods, lights / 4);
  EXPECT_LE(now - dawn, milliseconds(2));
  EXPECT_FALSE(round.admits(light, middle));
}

TEST(HubRound, TheFirstOfEitherKindAlwaysHasItsTurn) {
  const HubTurnKey light(false, 0, none), flood(true, 0, none);
  HubRound round(dawn, true);
  const HubTime late = dawn + milliseconds(100);
  EXPECT_TRUE(round.admits(light, late));
  EXPECT_TRUE(round.admits(flood, late));
  EXPECT_FALSE(round.admits(light, late));
  EXPECT_FALSE(round.admits(flood, late));
}

TEST(HubRound, WithoutFloodsTheOthersHaveAllOfIt) {
  const HubTurnKey light(false, 0, none);
  HubRound shared(dawn, true), whole(dawn, false);
  int in_shared = 0, in_whole = 0;
  for (HubTime now = dawn; now < dawn + milliseconds(5); now += microseconds(10)) {
    in_shared += shared.admits(light, now);
    in_whole += whole.admits(light, now);
  }
  EXPECT_GT(in_whole, in_shared);
}

/// What one hub would do with nothing but the order of turns: each turn takes `turn`.
TEST(HubRound, ASmallSenderWaitsForLessThanARoundAmongTwoHundredFloods) {
  std::vector<HubUsage> floods(200, HubUsage(dawn));
  HubUsage honest(dawn);
  HubTime now = dawn;
  const microseconds turn(50);
  for (int round = 0; round < 500; ++round) {
    HubRound one(now, true);
    const HubTime asked = now;
    ASSERT_TRUE(one.admits(HubTurnKey(false, honest.at(now), none), now));
    honest.add(20e-6, false, now);
    now += microseconds(20);
    EXPECT_LE(now - asked, milliseconds(1));
    for (HubUsage& flood : floods) {
      if (!one.admits(HubTurnKey(true, flood.at(now), none), now)) break;
      flood.add(50e-6, true, now);
      now += turn;
    }
    EXPECT_LE(now - asked, milliseconds(2));
  }
}

}  // namespace
}  // namespace genio
