#include "inverse/posterior/posterior.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "inverse/posterior/box_integral.hpp"

namespace genio {
namespace {

constexpr double far = 1e3;

BoxGaussian one(double mode, double slope, double curvature, double lower, double upper) {
  return {Vector::Constant(1, mode), Vector::Constant(1, slope), Matrix::Constant(1, 1, curvature),
          Vector::Constant(1, lower), Vector::Constant(1, upper)};
}

double mean(const Vector& v) { return v.mean(); }
double sd(const Vector& v) { return std::sqrt((v.array() - v.mean()).square().mean()); }

TEST(BoxGaussian, WithoutBoundsHasItsOwnMoments) {
  Matrix h(2, 2);
  h << 4, 1.9, 1.9, 1;  // strongly correlated
  const Matrix s = sample({Vector::Constant(2, 3), Vector::Zero(2), h, Vector::Constant(2, -far),
                           Vector::Constant(2, far)},
                          20000);
  const Matrix covariance = h.inverse();
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(mean(s.row(i)), 3, 0.05 * std::sqrt(covariance(i, i)));
    EXPECT_NEAR(sd(s.row(i)), std::sqrt(covariance(i, i)), 0.03 * std::sqrt(covariance(i, i)));
  }
}

TEST(BoxGaussian, AtABoundThatPressesIsExponential) {
  const Vector s = sample(one(0, 100, 1e-3, 0, 1), 20000).row(0);
  EXPECT_NEAR(mean(s), 0.01, 5e-4);
  EXPECT_NEAR(sd(s), 0.01, 5e-4);
  EXPECT_GE(s.minCoeff(), 0);
}

TEST(BoxGaussian, AtABoundThatDoesNotPressIsHalfAGaussian) {
  const Vector s = sample(one(0, 0, 100, 0, far), 20000).row(0);
  EXPECT_NEAR(mean(s), 0.1 * std::sqrt(2 / M_PI), 2e-3);
}

TEST(BoxGaussian, ABoundOnOneUnknownNarrowsWhatTradesWithIt) {
  // z0 + z1 is known to 0.01, each alone to 1: with both above 0 neither can exceed the sum.
  Matrix h = Matrix::Ones(2, 2) * 1e4 + Matrix::Identity(2, 2);
  const Matrix s = sample(
      {Vector::Constant(2, 0.1), Vector::Zero(2), h, Vector::Zero(2), Vector::Constant(2, 1)},
      20000);
  EXPECT_NEAR(sd(s.row(0)), 0.2 / std::sqrt(12.0), 5e-3);  // uniform on [0, 0.2]
  EXPECT_LT(s.row(0).maxCoeff(), 0.26);
}

// Its slope at a bound it does not press on was once taken for pressing on the other one.
TEST(BoxGaussian, FarFromItsModeIsStillAboutItsCentre) {
  const Vector s = sample(one(0, -4000, 1e4, 0, 1), 20000).row(0);
  EXPECT_NEAR(mean(s), 0.4, 1e-3);
  EXPECT_NEAR(sd(s), 0.01, 1e-3);
}

TEST(BoxGaussian, LogIntegralIsThatOfTheLimits) {
  EXPECT_NEAR(log_integral(one(0.5, 0, 1e4, 0, 1)), 0.5 * std::log(2 * M_PI / 1e4), 1e-12);
  EXPECT_NEAR(log_integral(one(0, 1e3, 1, 0, 1)), -std::log(1e3), 2e-6);
  EXPECT_NEAR(log_integral(one(0, 1e6, 1, 0, 1)), -std::log(1e6), 2e-5);
  // Half of it, and all but a bound's share.
  EXPECT_NEAR(log_integral(one(0, 0, 1e4, 0, 1)), 0.5 * std::log(2 * M_PI / 1e4) - M_LN2, 1e-9);
  EXPECT_NEAR(log_integral(one(0.01, 0, 1e4, 0, 1)),
              0.5 * std::log(2 * M_PI / 1e4) + std::log(1 - 0.5 * std::erfc(M_SQRT1_2)), 1e-9);
  EXPECT_NEAR(log_integral(one(0.5, 0, 1e-8, 0, 1)), 0, 1e-8);  // as good as even
}

TEST(Evidence, CountsWhatBoundsCutOffCorrelatedUnknowns) {
  // The orthant of two unknowns of correlation r holds 1/4 + asin(r) / (2 pi).
  for (double r : {-0.9, -0.5, 0.5, 0.9}) {
    Matrix covariance(2, 2);
    covariance << 1, r, r, 1;
    const BoxGaussian g{Vector::Zero(2), Vector::Zero(2), covariance.inverse(), Vector::Zero(2),
                        Vector::Constant(2, 50)};
    const double mass = 0.25 + std::asin(r) / (2 * M_PI);
    EXPECT_NEAR(log_integral(g),
                std::log(2 * M_PI) + 0.5 * std::log(covariance.determinant()) + std::log(mass),
                0.04)
        << r;
  }
}

TEST(Evidence, CountsAPointMassAtABound) {
  // By itself, and of two unknowns that trade: four cases, each an integral by itself.
  const double h = 1e4, spike = 0.05, between = std::sqrt(2 * M_PI / h);
  EXPECT_NEAR(integral(one(0, 0, h, 0, 1), Vector::Constant(1, spike)).log,
              std::log(0.5 * between + spike), 1e-6);
  Matrix hessian(2, 2);
  hessian << 900, 300, 300, 400;
  const Vector slope = Vector::Constant(2, -20), spikes = Vector::Constant(2, 0.1);
  const auto box = [&](const std::vector<Eigen::Index>& which) {
    const auto n = Eigen::Index(which.size());
    return std::exp(log_integral({Vector::Zero(n), slope(which), hessian(which, which),
                                  Vector::Zero(n), Vector::Constant(n, 1)}));
  };
  const double all = box({0, 1}) + 0.1 * box({0}) + 0.1 * box({1}) + 0.01;
  EXPECT_NEAR(
      integral({Vector::Zero(2), slope, hessian, Vector::Zero(2), Vector::Constant(2, 1)}, spikes)
          .log,
      std::log(all), 0.05);
}

TEST(Evidence, IsThatOfEqualCorrelationsInTenUnknowns) {
  // Of correlation 1/2 the orthant holds 1 / (n + 1), as the largest of n + 1 equals is any.
  constexpr int n = 10;
  const Matrix covariance = 0.5 * (Matrix::Identity(n, n) + Matrix::Ones(n, n));
  const BoxGaussian g{Vector::Zero(n), Vector::Zero(n), covariance.inverse(), Vector::Zero(n),
                      Vector::Constant(n, 50)};
  EXPECT_NEAR(
      log_integral(g),
      0.5 * n * std::log(2 * M_PI) + 0.5 * std::log(covariance.determinant()) - std::log(n + 1),
      0.05);
}

TEST(BoxIntegral, CentresAnUnknownOnWhatTheOthersLeaveIt) {
  // z0 + z1 is seen, z1 >= 0 rests as often as it pulls: z0 makes up for half of what z1 might do.
  Matrix hessian(2, 2);
  hessian << 110, 100, 100, 125;
  const Vector slope = Vector::Zero(2), spikes{{0, 0.2}};
  const BoxGaussian g{Vector{{5, 0}}, slope, hessian, Vector{{0, 0}}, Vector{{10, 10}}};
  double mass = 0, first = 0, second = 0;
  for (int i = -4000; i <= 4000; ++i)
    for (int j = 0; j <= 2000; ++j) {
      const double x = 2.5e-4 * i, y = 5e-4 * j;
      const double weight = j == 0 ? spikes[1] + 2.5e-4 : 5e-4;  // half a step, and the point
      const double p = weight * std::exp(-0.5 * (110 * x * x + 200 * x * y + 125 * y * y));
      mass += p, first += p * x, second += p * x * x;
    }
  const BoxIntegral all = integral(g, spikes);
  const double mean_of_x = first / mass;
  EXPECT_LT(mean_of_x, -0.02);
  EXPECT_NEAR(all.centre[0], 5 + mean_of_x, 0.1 * std::abs(mean_of_x));
  EXPECT_NEAR(all.sd[0], std::sqrt(second / mass - mean_of_x * mean_of_x), 0.05 * all.sd[0]);
}

TEST(CutNormal, HasTheShortestIntervalThatHoldsNineInTen) {
  const CutNormal inside = cut_normal(2, 0.1, 0, 10);
  EXPECT_NEAR(inside.low, 2 - 0.16449, 1e-4);
  EXPECT_NEAR(inside.high, 2 + 0.16449, 1e-4);
  EXPECT_NEAR(inside.sd, 0.1, 1e-6);
  const CutNormal half = cut_normal(0, 0.1, 0, 10);
  EXPECT_EQ(half.low, 0);
  EXPECT_NEAR(half.high, 0.16449, 1e-4);
  // Far beyond a bound it is an exponential of slope distance / variance.
  const CutNormal pressed = cut_normal(-100, 1, 0, 10);
  EXPECT_EQ(pressed.mode, 0);
  EXPECT_EQ(pressed.low, 0);
  EXPECT_NEAR(pressed.high, std::log(10) / 100, 1e-4);
  const CutNormal above = cut_normal(11, 1, 0, 10);
  EXPECT_EQ(above.mode, 10);
  EXPECT_EQ(above.high, 10);
  EXPECT_LT(above.low, 9.2);
  // As good as even: anything nine tenths as long would do, this one holds the centre.
  const CutNormal even = cut_normal(0.3, 1e4, 0, 1);
  EXPECT_NEAR(even.high - even.low, 0.9, 1e-3);
}

TEST(Marginal, FarFromBoundsIsCentral) {
  const auto s = summarise(sample(one(0.5, 0, 400, 0, 1), 20000).row(0), 0, 1);
  EXPECT_NEAR(s.sd, 0.05, 2e-3);
  EXPECT_NEAR(s.low, 0.5 - 1.6449 * 0.05, 4e-3);
  EXPECT_NEAR(s.high, 0.5 + 1.6449 * 0.05, 4e-3);
}

TEST(Marginal, AtABoundIsOneSided) {
  const auto s = summarise(sample(one(0, 100, 1e-3, 0, 1), 20000).row(0), 0, 1);
  EXPECT_EQ(s.low, 0);
  EXPECT_NEAR(s.high, std::log(10.0) / 100, 2e-3);
}

TEST(Marginal, CountsWeightsAsRepetition) {
  const Vector thrice{{0.1, 0.1, 0.1, 0.3, 0.8}}, once{{0.8, 0.1, 0.3}}, weights{{1, 3, 1}};
  const auto a = summarise(thrice, 0, 1), b = summarise(once, weights, 0, 1);
  EXPECT_NEAR(a.mean, b.mean, 1e-12);
  EXPECT_NEAR(a.sd, b.sd, 1e-12);
  EXPECT_EQ(a.median, b.median);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

TEST(ActingSummary, ReachesRestUnlessTheMuscleSurelyActs) {
  Vector samples = Vector::LinSpaced(1000, 0.4, 0.6);
  const Vector weights = Vector::Constant(1000, 1e-3);
  const auto surely = summarise_acting(samples, weights, 1);
  EXPECT_NEAR(surely.acts, 1, 1e-9);
  EXPECT_NEAR(surely.force.high - surely.force.low, 0.18, 1e-3);
  samples.head(100).setZero();
  const auto open = summarise_acting(samples, weights, 1);
  EXPECT_NEAR(open.acts, 0.9, 1e-9);
  EXPECT_EQ(open.force.low, 0);
  EXPECT_GT(open.force.high, 0.57);
  EXPECT_NEAR(open.force.mean, samples.mean(), 1e-12);
  const auto rest = summarise_acting(Vector::Zero(10), Vector::Constant(10, 0.1), 1);
  EXPECT_EQ(rest.acts, 0);
  EXPECT_EQ(rest.force.high, 0);
}

TEST(Marginals, SamplesThatAreNoNumbersAreRefused) {
  // Sorting them would go beyond their ends.
  Vector samples = Vector::LinSpaced(1000, 0, 1), weights = Vector::Ones(1000);
  for (Eigen::Index i = 0; i < 1000; i += 3) samples[i] = std::nan("");
  EXPECT_THROW(summarise(samples, weights, 0, 1), InputError);
  EXPECT_THROW(summarise_acting(samples, weights, 1), InputError);
  weights[7] = std::nan("");
  EXPECT_THROW(summarise(Vector::Ones(1000), weights, 0, 1), InputError);
}

TEST(UnseenDirections, NameWhatTradesForWhat) {
  // The data see only 2 z0 + z1; a third command is seen well.
  Matrix j(2, 3);
  j << 200, 100, 0, 0, 0, 100;
  const std::vector<Unknown> unknowns = {{"A", 2, {}, {}}, {"B", 3, {}, {}}, {"C", 1, {}, {}}};
  const auto trades = unseen_directions(j, Matrix::Identity(3, 3), unknowns);
  ASSERT_EQ(trades.size(), 1u);
  ASSERT_EQ(names(trades[0]), (std::vector<std::string>{"A", "B"}));
  EXPECT_NEAR(trades[0][0].amount / trades[0][1].amount, -0.5 * 2 / 3, 1e-3);
  EXPECT_NEAR(std::abs(trades[0][1].amount), 3, 1e-9);
}

}  // namespace
}  // namespace genio
