// Tails and quantiles against tables (Abramowitz & Stegun 1964, chapter 26).

#include "inverse/posterior/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace genio {
namespace {

TEST(Distributions, ChiSquareTailsAreThoseOfTheTable) {
  EXPECT_NEAR(chi_square_tail(2.70554, 1), 0.10, 1e-6);
  EXPECT_NEAR(chi_square_tail(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(6.63490, 1), 0.01, 1e-6);
  EXPECT_NEAR(chi_square_tail(10.82757, 1), 0.001, 1e-6);
  EXPECT_NEAR(chi_square_tail(4.60517, 2), 0.10, 1e-6);
  EXPECT_NEAR(chi_square_tail(9.21034, 2), 0.01, 1e-6);
  EXPECT_NEAR(chi_square_tail(6.25139, 3), 0.10, 1e-6);
  EXPECT_NEAR(chi_square_tail(7.81473, 3), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(11.34487, 3), 0.01, 1e-6);
  EXPECT_NEAR(chi_square_tail(15.98718, 10), 0.10, 1e-6);
  EXPECT_NEAR(chi_square_tail(18.30704, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(23.20925, 10), 0.01, 1e-6);
  EXPECT_NEAR(chi_square_tail(50.892, 30), 0.01, 1e-6);
  EXPECT_NEAR(chi_square_tail(29.336, 30), 0.5, 1e-5);
}

TEST(Distributions, ChiSquareOfOneIsANormalSquared) {
  for (double z : {0.1, 1.0, 2.5, 6.0})
    EXPECT_NEAR(chi_square_tail(z * z, 1), 2 * normal_tail(z), 1e-14);
}

TEST(Distributions, ChiSquareOfTwoIsExponential) {
  for (double chi2 : {0.0, 0.5, 3.0, 40.0})
    EXPECT_NEAR(chi_square_tail(chi2, 2), std::exp(-0.5 * chi2), 1e-14);
}

TEST(Distributions, ChiSquareTailEndsAtZeroAndRefusesNonsense) {
  EXPECT_EQ(chi_square_tail(INFINITY, 3), 0);
  EXPECT_TRUE(std::isnan(chi_square_tail(-1, 3)));
  EXPECT_TRUE(std::isnan(chi_square_tail(1, 0)));
  EXPECT_TRUE(std::isnan(chi_square_tail(NAN, 3)));
}

TEST(Distributions, NormalQuantilesAreThoseOfTheTable) {
  EXPECT_NEAR(normal_quantile(0.5), 0, 1e-15);
  EXPECT_NEAR(normal_quantile(0.1), 1.281551565544600, 1e-14);
  EXPECT_NEAR(normal_quantile(0.05), 1.644853626951473, 1e-14);
  EXPECT_NEAR(normal_quantile(0.025), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.95), -1.644853626951473, 1e-14);
}

TEST(Distributions, QuantileInvertsTail) {
  for (double p : {1e-12, 1e-6, 0.003, 0.4, 0.8})
    EXPECT_NEAR(normal_tail(normal_quantile(p)) / p, 1, 1e-12);
}

}  // namespace
}  // namespace genio
