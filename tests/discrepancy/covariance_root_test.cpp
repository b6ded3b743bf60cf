// A root of few columns has the covariance to the accuracy asked for.

#include "discrepancy/errors/covariance_root.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace genio {
namespace {

/// Points along a line whose values are alike over a length.
double alike(Eigen::Index i, Eigen::Index j) {
  const double apart = 0.05 * double(i - j);
  return 4 * std::exp(-0.5 * apart * apart);
}

TEST(CovarianceRoot, LeavesNoMoreOfAVarianceThanItMay) {
  constexpr Eigen::Index n = 200;
  Matrix c(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) c(i, j) = alike(i, j);
  Eigen::Index fewer = n;
  for (const double least : {1e-6, 1e-3, 1e-1}) {
    const Matrix root = covariance_root(n, alike, least / alike(0, 0));
    EXPECT_LT((c - root * root.transpose()).cwiseAbs().maxCoeff(), least);
    EXPECT_LT(root.cols(), fewer);
    fewer = root.cols();
  }
  EXPECT_LT(fewer, 20);
}

TEST(CovarianceRoot, OfIndependentValuesHasThemAll) {
  const auto apart = [](Eigen::Index i, Eigen::Index j) { return i == j ? 1.0 + double(i) : 0.0; };
  const Matrix root = covariance_root(100, apart, 1e-9);
  ASSERT_EQ(root.cols(), 100);
  const Matrix c = root * root.transpose();
  for (Eigen::Index i = 0; i < 100; ++i) EXPECT_NEAR(c(i, i), apart(i, i), 1e-12);
  EXPECT_EQ(covariance_root(
                100, [](auto, auto) { return 0.0; }, 0)
                .cols(),
            0);
}

}  // namespace
}  // namespace genio
