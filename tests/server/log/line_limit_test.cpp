#include "server/log/line_limit.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

int passed(LineLimit& limit, LogKind kind, int lines, double now) {
  int count = 0;
  for (int k = 0; k < lines; ++k) count += limit.passes(kind, now);
  return count;
}

TEST(LineLimit, SoManyPassInASecondAndAgainInTheNext) {
  LineLimit limit(50);
  EXPECT_EQ(passed(limit, LogKind::answered, 50, 0), 50);
  EXPECT_EQ(passed(limit, LogKind::answered, 10, 0.99), 0);
  EXPECT_EQ(passed(limit, LogKind::answered, 60, 1.0), 50);
  EXPECT_EQ(passed(limit, LogKind::answered, 60, 1000), 50);
}

TEST(LineLimit, AFloodOfOneKindLeavesTheOthersAlone) {
  LineLimit limit(5);
  passed(limit, LogKind::refused, 100000, 3);
  EXPECT_TRUE(limit.passes(LogKind::stopped, 3));
}

TEST(LineLimit, WhatWasLeftOutIsToldOnceItsSecondIsOver) {
  LineLimit limit(2);
  passed(limit, LogKind::refused, 7, 10);
  EXPECT_TRUE(limit.take_left_out(10.5).empty());
  const auto told = limit.take_left_out(11);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, LogKind::refused);
  EXPECT_EQ(told[0].lines, 5);
  EXPECT_TRUE(limit.take_left_out(12).empty());
}

TEST(LineLimit, EveryLineIsWrittenOrCounted) {
  LineLimit limit(3);
  int64_t written = 0, left_out = 0;
  for (int k = 0; k < 10000; ++k) {
    written += passed(limit, LogKind::answered, 1, 0.001 * k);
    for (const auto& l : limit.take_left_out(0.001 * k)) left_out += l.lines;
  }
  for (const auto& l : limit.take_left_out(10, true)) left_out += l.lines;
  EXPECT_EQ(written, 30);
  EXPECT_EQ(written + left_out, 10000);
}

}  // namespace
}  // namespace genio
