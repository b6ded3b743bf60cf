// Shapes out of a model's reach are as far out as they are said to be.

#include "bench/truths/beyond_reach.hpp"

#include <gtest/gtest.h>

#include "bench/truths/measured_shape.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/search/multi_start.hpp"
#include "tests/forward/small_model.hpp"

namespace genio::bench {
namespace {

class BeyondReach : public testing::Test {
 protected:
  const ModelDescription description = read_description(test::generic_model());
  const Model model = build_model(description, "generic");
  std::mt19937 random{3};
};

TEST_F(BeyondReach, APushedSurfaceIsAsManyNoisesOffAsNoForcesCanFollow) {
  constexpr double noise = 0.3e-3, noises = 6;
  const Target target = measured_shape(model, model.rest, Measurement::surface, noise, random);
  InferWorkspace ws(model);
  const Answer near = infer_from_starts(model, target, Prior{}, ws, {}, {1});
  ASSERT_EQ(near.status, InferStatus::converged);
  const Target away = pushed(target, near, noises, random);
  const Answer far = infer_from_starts(model, away, Prior{}, ws, {}, {1});
  EXPECT_LT(noises_off(near), 1);
  EXPECT_GT(noises_off(far), 0.7 * noises);
  EXPECT_LT(noises_off(far), 1.3 * noises);
  EXPECT_NE(far.verdict, Verdict::explained);
}

TEST_F(BeyondReach, AnotherAnatomyIsLongerOrShorterAndItsFibresGoWithIt) {
  const ModelDescription other = beyond_tongue(description, Beyond::other_anatomy, random);
  const auto extent = [](const ModelDescription& d) {
    Vec3 low = d.mesh.nodes.front(), high = low;
    for (const Vec3& x : d.mesh.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
    return Vec3(high - low);
  };
  const Vec3 by = extent(other).cwiseQuotient(extent(description));
  EXPECT_GT(std::abs(by[0] - 1), 0.05);
  EXPECT_NEAR(by[1], 1, 1e-12);
  EXPECT_GT(std::abs(by[2] - 1), 0.05);
  EXPECT_NO_THROW(build_model(other, "other"));
}

TEST_F(BeyondReach, AnOpenJawIsOpenAndASurfaceHasNoTongue) {
  const ModelDescription open = beyond_tongue(description, Beyond::open_jaw, random);
  EXPECT_GT(open.effects.at("jaw_opening").at("angle"), 3.9);
  EXPECT_THROW(beyond_tongue(description, Beyond::pushed_surface, random), std::invalid_argument);
}

}  // namespace
}  // namespace genio::bench
