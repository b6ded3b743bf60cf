#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/target.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(TongueLine, PassesThroughItsNodes) {
  const Model m = read_model(test::generic_model());
  const TongueLine line(m);
  for (int a : m.midsagittal) {
    const Vec3 x = m.mesh.nodes[size_t(a)];
    EXPECT_NEAR(line.closest(m.rest, Vec2(x[0], x[2])).distance, 0, 1e-12);
  }
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
  t.curve.push_back({Vec2(0.12, 0.055), 1e-3});  // beyond the end of the line
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
