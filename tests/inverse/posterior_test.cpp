#include "inverse/posterior.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace genio {
namespace {

TEST(Marginal, FarFromBoundsIsGaussian) {
  const auto s = summarise({0.5, 0, 400}, false, false);
  EXPECT_NEAR(s.sd, 0.05, 1e-4);
  EXPECT_NEAR(s.low, 0.5 - 1.6449 * 0.05, 1e-4);
  EXPECT_NEAR(s.high, 0.5 + 1.6449 * 0.05, 1e-4);
}

TEST(Marginal, AtABoundIsExponential) {
  const auto s = summarise({0, 100, 1e-6}, true, false);
  EXPECT_NEAR(s.sd, 0.01, 1e-4);
  EXPECT_EQ(s.low, 0);
  EXPECT_NEAR(s.high, std::log(10.0) / 100, 1e-4);
}

TEST(Marginal, IntervalHoldsItsModeNearABound) {
  const auto s = summarise({0.001, 0, 400}, false, false);
  EXPECT_LE(s.low, 0.001);
  EXPECT_GE(s.high, 0.001);
}

TEST(ChiSquare, TailMeetsTheTables) {
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 1e-3);
  EXPECT_NEAR(chi_square_tail(50.892, 30), 0.01, 1e-3);
  EXPECT_NEAR(chi_square_tail(29.336, 30), 0.5, 2e-3);
}

}  // namespace
}  // namespace genio
