#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/target.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(TongueLine, RunsAlongTheEdgesOfTheSurface) {
  const Model m = read_model(test::generic_model());
  const TongueLine line(m);
  for (size_t k = 1; k < m.midsagittal.size(); ++k) {
    const Vec3 a = m.mesh.nodes[size_t(m.midsagittal[k - 1])],
               b = m.mesh.nodes[size_t(m.midsagittal[k])], middle = 0.5 * (a + b);
    if ((b - a).norm() > 4e-3) {
      EXPECT_NEAR(line.closest(m.rest, {middle[0], middle[2]}).distance, 0, 1e-9) << k;
    }
    EXPECT_LT(std::abs(line.closest(m.rest, {b[0], b[2]}).distance), 4e-4) << k;
  }
}

TEST(TongueLine, IsOneSurfaceWithTheFacets) {
  const Model m = read_model(test::generic_model());
  Target on_line;
  for (const Vec2& q : TongueLine(m).sample(m.rest, 100))
    on_line.surface.push_back({Vec3(q[0], 0, q[1]), 5e-4});
  EXPECT_LT(Comparison(m, on_line)(m.rest).rms, 1.2e-4);
}

TEST(TongueLine, HasContinuousSecondDerivatives) {
  const Model m = read_model(test::generic_model());
  const TongueLine line(m);
  const double h = 1e-7;
  for (int i = 0; i <= 400; ++i) {
    const double t = line.length() * i / 400;
    for (int d : {0, 1}) {
      const Vector quotient = (line.weights(t + h, d) - line.weights(t - h, d)) / (2 * h);
      EXPECT_LT((quotient - line.weights(t, d + 1)).norm(), d == 0 ? 1e-3 : 1) << t;
    }
  }
}

TEST(Comparison, PointsBeyondTheEndCostTheirDistance) {
  const Model m = read_model(test::generic_model());
  const TongueLine line(m);
  const double last = line.length();
  const Vec2 end = line.point(m.rest, last),
             along = (end - line.point(m.rest, last - 1e-3)).normalized();
  Target t;
  for (const double beyond : {0.0, 0.02, 0.06}) t.curve.push_back({end + beyond * along, 5e-4});
  const Residuals r = Comparison(m, t)(m.rest);
  EXPECT_NEAR(r.distances[0], 0, 1e-6);
  EXPECT_NEAR(r.distances[1], 0.02, 1e-6);
  EXPECT_NEAR(r.distances[2], 0.06, 1e-6);
  EXPECT_GT(std::abs(r.values[1]), 9);
  EXPECT_GT(std::abs(r.values[2]), 28);
  // Another speaker's line may be longer.
  for (CurvePoint& p : t.curve) p.longer = 0.03;
  const Residuals of_another = Comparison(m, t)(m.rest);
  EXPECT_NEAR(of_another.distances[1], 0, 1e-6);
  EXPECT_NEAR(of_another.distances[2], 0.03, 1e-6);
  EXPECT_NEAR(of_another.values[2] / r.values[2], 0.5, 1e-3);
}

TEST(TongueLine, DistanceIsPositiveOutside) {
  const Model m = read_model(test::generic_model());
  const TongueLine line(m);
  const Vec3 top = m.mesh.nodes[size_t(m.landmarks.dorsum)];
  EXPECT_NEAR(line.closest(m.rest, Vec2(top[0], top[2] + 3e-3)).distance, 3e-3, 1e-4);
  EXPECT_LT(line.closest(m.rest, Vec2(top[0], top[2] - 3e-3)).distance, 0);
}

/// All three kinds of target at once: analytic against central differences.
TEST(Comparison, GradientIsTheDerivativeOfTheResiduals) {
  const Model m = read_model(test::generic_model());
  Target t = curve_target(m, m.rest, 20, 5e-4);
  for (auto& p : t.curve) p.position += Vec2(1e-3, 1.5e-3);
  // Beyond the end of the line, and of one that may be longer.
  for (const double longer : {0.0, 4e-3, 0.1}) t.curve.push_back({Vec2(0.12, 0.055), 1e-3, longer});
  t.flesh.push_back({{{m.landmarks.tip, 1.0}}, Vec3(0.055, std::nan(""), 0.1), 1e-3, "tip"});
  t.surface.push_back({Vec3(0.095, 0.012, 0.118), 1e-3});
  const Comparison compare(m, t);
  const Residuals r = compare(m.rest);
  Vector step = test::shaken(m, 1.0, 5) - m.rest;
  for (double h : {1e-6}) {
    const Vector quotient =
        (compare(m.rest + h * step).values - compare(m.rest - h * step).values) / (2 * h);
    for (Eigen::Index i = 0; i < quotient.size(); ++i) {
      double exact = 0;
      for (const auto& [node, g] : r.gradient[size_t(i)]) exact += g.dot(step.segment<3>(3 * node));
      EXPECT_NEAR(quotient[i], exact, 1e-4 * (1 + std::abs(exact))) << i;
    }
  }
}

}  // namespace
}  // namespace genio
