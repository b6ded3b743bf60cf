// The whole workflow on data of the model's own mesh, where no mesh error has to be taken off.

#include "discrepancy/contest/discover.hpp"

#include "forward/model/build_model.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

class Discover : public test::PosedTongue {
 protected:
  Discovery found(const ModelDescription& truth) {
    Observations o = observed(truth, true);
    o.conditions.back().heldout = true;
    DiscoverOptions options;
    options.correct_mesh = false, options.refits = 2;
    return discover(tongue, o, options);
  }
};

TEST_F(Discover, NamesNothingWhereNothingIsHidden) {
  const Discovery d = found(tongue);
  EXPECT_EQ(d.verdict, DiscoveryVerdict::none) << d.message;
  EXPECT_TRUE(d.effects.empty());
  EXPECT_TRUE(d.map_before.patches.empty());
}

TEST_F(Discover, NamesAnOpenJawAndTheGapShrinksAlsoWhereItDidNotLook) {
  ModelDescription truth = tongue;
  truth.effects["jaw_opening"] = {{"angle", 3}};
  const Discovery d = found(truth);
  ASSERT_FALSE(d.effects.empty()) << to_string(d.verdict) << ": " << d.message;
  EXPECT_EQ(d.effects[0].effect, "jaw_opening");
  ASSERT_EQ(d.effects[0].parameters.size(), 1u);
  EXPECT_NEAR(d.effects[0].parameters[0].value, 3, 0.3);
  EXPECT_LT(d.after.rms, 0.3 * d.before.rms);
  EXPECT_LT(d.heldout_after.rms, 0.3 * d.heldout_before.rms);
  EXPECT_FALSE(d.map_before.patches.empty());
  EXPECT_TRUE(d.map_after.patches.empty());
  EXPECT_GT(d.hidden.log_evidence, 0);
  EXPECT_NEAR(d.model.effects.at("jaw_opening").at("angle"), 3, 0.3);
}

TEST(Verdict, NamesNothingWhileAGapBeyondNoiseIsLeft) {
  const DiscoverOptions options;  // 0.01 of the test, 0.9 of the probability
  EXPECT_EQ(verdict_of({0.99}, 0.001, 0.5, options), DiscoveryVerdict::unknown);
  EXPECT_EQ(verdict_of({}, 0.001, 0.5, options), DiscoveryVerdict::unknown);
  EXPECT_EQ(verdict_of({}, 0.5, 0.001, options), DiscoveryVerdict::unknown);
  EXPECT_EQ(verdict_of({}, 0.5, 0.5, options), DiscoveryVerdict::none);
}

TEST(Verdict, IsAmbiguousWhereOneOfTheEffectsIsUncertain) {
  const DiscoverOptions options;
  EXPECT_EQ(verdict_of({0.99, 0.95}, 0.5, 0.5, options), DiscoveryVerdict::named);
  EXPECT_EQ(verdict_of({0.99, 0.6}, 0.5, 0.5, options), DiscoveryVerdict::ambiguous);
}

}  // namespace
}  // namespace genio
