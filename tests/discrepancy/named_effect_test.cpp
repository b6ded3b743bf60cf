// Intervals hold what the error model leaves open.

#include "discrepancy/contest/named_effect.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inverse/posterior/distributions.hpp"

namespace genio {
namespace {

const double ninety = normal_quantile(0.05);

FreeNumber between(double lower, double upper) {
  return {.info = {.lower = lower, .upper = upper}};
}

TEST(Intervals, AreAsWideAsTheErrorModelMakesThem) {
  const SharedEstimate fitted{{"e", "v"}, "N", 10, 1, 10 - ninety, 10 + ninety};
  const SharedEstimate same = widened(fitted, between(-100, 100), 0);
  EXPECT_DOUBLE_EQ(same.low, fitted.low);
  EXPECT_DOUBLE_EQ(same.high, fitted.high);
  const SharedEstimate wider = widened(fitted, between(-100, 100), 1);
  EXPECT_NEAR(wider.sd, std::sqrt(2), 1e-12);
  EXPECT_NEAR(wider.high - 10, ninety * std::sqrt(2), 1e-12);
  EXPECT_NEAR(10 - wider.low, wider.high - 10, 1e-12);
  EXPECT_EQ(widened(fitted, between(9, 10.5), 1).low, 9);
}

TEST(Intervals, AreSkewedAwayFromWhereAnEffectVanishes) {
  const SharedEstimate fitted{{"e", "v"}, "N", 10, 3, 10 - 4.9, 10 + 4.9};
  const SharedEstimate up = widened(fitted, between(0, 100), 0);
  EXPECT_NEAR(up.high, 10 * std::exp(0.49), 1e-9);
  EXPECT_NEAR(up.low, fitted.low, 1e-12);
  SharedEstimate mirrored = fitted;
  mirrored.value = -10, mirrored.low = -14.9, mirrored.high = -5.1;
  const SharedEstimate down = widened(mirrored, between(-100, 0), 0);
  EXPECT_NEAR(down.low, -up.high, 1e-9);
  EXPECT_NEAR(down.high, -up.low, 1e-9);
}

TEST(Intervals, OfAFactorAreThoseOfItsLogarithm) {
  FreeNumber number = between(0.05, 100);
  number.info.absent = 1, number.belief.ratio = true;
  const SharedEstimate fitted{{"stiff_region", "factor"}, "1", 8, 4, 4, 16};
  const SharedEstimate same = widened(fitted, number, 0);
  EXPECT_NEAR(same.low, 4, 1e-12);
  EXPECT_NEAR(same.high, 16, 1e-12);
  const SharedEstimate wider = widened(fitted, number, 0.1 * std::log(8));
  EXPECT_NEAR(wider.low * wider.high, 64, 1e-9);
  EXPECT_NEAR(std::log(wider.high / 8), std::hypot(std::log(2), 0.1 * ninety * std::log(8)), 1e-9);
}

}  // namespace
}  // namespace genio
