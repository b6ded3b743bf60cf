// Two models of the same data are separated by postures in which they differ.

#include "discrepancy/contest/separation.hpp"

#include "inverse/target/head_pose.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

class Separation : public test::PosedTongue {
 protected:
  ModelDescription heavy() const {
    ModelDescription d = tongue;
    d.effects["gravity"] = {{"x", 0}, {"y", 0}, {"z", -5}};
    return d;
  }
};

TEST_F(Separation, AModelIsNotSeparatedFromItself) {
  for (const Experiment& e : experiments({tongue, {}}, {tongue, {}}, observed(tongue, true)))
    EXPECT_LT(e.log_odds, 1e-2) << e.label();
}

TEST_F(Separation, LyingDownTellsWeightFromAWrongPose) {
  // A pose that makes up for what the weight does to the tongue at rest.
  HeadPose pose;
  pose.shift = Vec2(0, -5e-4);
  const auto best = experiments({heavy(), {}}, {tongue, pose}, observed(tongue, true), 100);
  ASSERT_FALSE(best.empty());
  EXPECT_NE(best.front().pitch, 0) << best.front().label();
  for (size_t i = 1; i < best.size(); ++i) EXPECT_LE(best[i].log_odds, best[i - 1].log_odds);
  for (const auto& [what, odds] : best.front().further)
    EXPECT_GE(odds, best.front().log_odds - 1e-6) << what;
  EXPECT_EQ(best.front().further.size(), 5u);
  EXPECT_TRUE(best.back().further.empty());
}

TEST_F(Separation, WithoutGravityNobodyLiesDown) {
  ModelDescription open = tongue;
  open.effects["jaw_opening"] = {{"angle", 3}};
  for (const Experiment& e : experiments({tongue, {}}, {open, {}}, observed(tongue, false))) {
    EXPECT_EQ(e.pitch, 0);
    EXPECT_GT(e.log_odds, 0);
  }
}

}  // namespace
}  // namespace genio
