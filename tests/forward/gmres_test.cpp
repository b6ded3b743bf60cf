#include "forward/algebra/gmres.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

// Eigenvalues on both sides of 1, where the plain iteration x = b + (1 - A) x blows up.
TEST(Gmres, SolvesEachColumnWhereTheFixedPointDiverges) {
  srand(7);
  const Eigen::Index n = 60, columns = 5;
  Matrix a = Matrix::Identity(n, n);
  for (int k = 0; k < 6; ++k) {
    const Vector p = Vector::Random(n), q = Vector::Random(n);
    a += (k - 2.5) * 0.4 * p * q.transpose() / std::sqrt(double(n));
  }
  const Matrix b = Matrix::Random(n, columns);
  Matrix x = Matrix::Zero(n, columns);
  int applied = 0;
  const auto apply = [&](const Matrix& v) { return ++applied, Matrix(a * v); };
  ASSERT_TRUE(gmres(apply, b, 1e-10, 60, x));
  EXPECT_LT((a * x - b).norm(), 1e-9 * b.norm());
  EXPECT_LT(applied, 40);
}

TEST(Gmres, NothingAskedIsNothingAndAGoodStartCostsOneLook) {
  const Matrix a = 2 * Matrix::Identity(4, 4);
  int applied = 0;
  const auto apply = [&](const Matrix& v) { return ++applied, Matrix(a * v); };
  Matrix b = Matrix::Zero(4, 2), x = b;
  EXPECT_TRUE(gmres(apply, b, 1e-6, 10, x));
  EXPECT_EQ(x.norm(), 0);
  b.setOnes(), x.setConstant(0.5), applied = 0;
  EXPECT_TRUE(gmres(apply, b, 1e-6, 10, x));
  EXPECT_EQ(applied, 1);
}

TEST(Gmres, SaysWhenItDoesNotConverge) {
  Matrix turn = Matrix::Zero(40, 40);  // a cyclic shift: nothing is gained before 40 steps
  for (int i = 0; i < 40; ++i) turn((i + 1) % 40, i) = 1;
  const auto apply = [&](const Matrix& v) { return Matrix(turn * v); };
  Matrix x = Matrix::Zero(40, 1);
  EXPECT_FALSE(gmres(apply, Matrix(Vector::Unit(40, 0)), 1e-6, 30, x));
}

}  // namespace
}  // namespace genio
