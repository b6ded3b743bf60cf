#include "runs/results/answer_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace genio {
namespace {

Target points_along(double height) {
  Target t;
  for (int k = 0; k < 40; ++k) t.curve.push_back({Vec2(0.06 + 0.001 * k, height), 5e-4});
  return t;
}

TEST(AnswerViews, MeasuredPointsStandWhereTheHeadIsEstimated) {
  const Target t = points_along(0.1);
  const std::vector<Estimate> others = {{.name = "head_pose.x", .best = 0.002},
                                        {.name = "head_pose.z", .best = -0.001},
                                        {.name = "head_pose.turn", .best = 0.3}};
  const Vec2 middle = t.middle();
  const auto points = measured_points(t, others);
  ASSERT_EQ(points.size(), t.curve.size());
  for (size_t k = 0; k < points.size(); ++k) {
    const double along = t.curve[k].position[0] - middle[0];
    EXPECT_NEAR(points[k][0], middle[0] + 0.002 + along * std::cos(0.3), 1e-12);
    EXPECT_NEAR(points[k][1], middle[1] - 0.001 + along * std::sin(0.3), 1e-12);
  }
}

TEST(AnswerViews, WithoutAHeadPoseTheyStandAsMeasured) {
  const Target t = points_along(0.1);
  const auto points = measured_points(t, {});
  for (size_t k = 0; k < points.size(); ++k)
    EXPECT_LT((points[k] - t.curve[k].position).norm(), 1e-15);
}

}  // namespace
}  // namespace genio
