#include "server/hub/turns/pace.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(HubPace, RestsAsLongAsItWorked) {
  HubPace pace;
  EXPECT_FALSE(pace.rests());
  pace.worked(milliseconds(3));
  EXPECT_TRUE(pace.rests());
  EXPECT_EQ(pace.left(), milliseconds(3));
  pace.slept(milliseconds(2));
  EXPECT_TRUE(pace.rests());
  pace.slept(milliseconds(1));
  EXPECT_FALSE(pace.rests());
}

TEST(HubPace, PutsShortRestsTogether) {
  HubPace pace;
  for (int k = 0; k < 9; ++k) pace.worked(microseconds(100));
  EXPECT_FALSE(pace.rests());
  pace.worked(microseconds(100));
  EXPECT_TRUE(pace.rests());
}

TEST(HubPace, NeverRestsWhereThereIsNothingToDoForHalfOfTheTime) {
  HubPace pace;
  for (int k = 0; k < 10000; ++k) {
    pace.worked(microseconds(100));
    pace.slept(microseconds(100));
    ASSERT_FALSE(pace.rests());
  }
}

TEST(HubPace, AFloodHasHalfOfTheTime) {
  HubPace pace;
  microseconds worked(0), slept(0);
  while (worked + slept < std::chrono::seconds(1)) {
    if (pace.rests()) {
      slept += microseconds(50);
      pace.slept(microseconds(50));
    } else {
      worked += microseconds(50);
      pace.worked(microseconds(50));
    }
  }
  EXPECT_NEAR(double(worked.count()), double(slept.count()), 2000);
}

TEST(HubPace, NoRestIsLongAndNoneComesOnceItEnded) {
  HubPace pace;
  pace.worked(std::chrono::seconds(10));
  EXPECT_TRUE(pace.rests());
  EXPECT_LE(pace.left(), milliseconds(20));
  pace.end();
  EXPECT_FALSE(pace.rests());
  pace.worked(std::chrono::seconds(10));
  EXPECT_FALSE(pace.rests());
}

}  // namespace
}  // namespace genio
