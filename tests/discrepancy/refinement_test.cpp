// What the coarse mesh gets wrong is found once for shapes that are alike.

#include "discrepancy/errors/refinement.hpp"

#include "discrepancy/candidates/symmetric_part.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

class RefinementTest : public test::PosedTongue {};

TEST_F(RefinementTest, AChangeOfOneSideLeavesTheMeshErrorAsItWas) {
  const Observations seen = observed(tongue, true);
  const auto all = fitted_conditions(seen);
  ConditionSet plain(tongue, seen, all);
  const JointFit before = fit(plain, {}, nullptr);
  ASSERT_EQ(before.conditions.size(), all.size()) << before.message;
  const auto [expected, refinement] = Refinement(tongue, seen).corrections(plain, before);

  Candidate pull{"extra_muscle", "chondroglossus_R", {}, {}};
  for (const Hypothesis& h : hypotheses(tongue))
    if (h.effect == pull.effect && h.where == pull.where)
      pull.hypothesis = h, pull.strengths = h.strengths;
  ASSERT_TRUE(pull.hypothesis);
  ModelDescription lopsided = pull.hypothesis->added_to(tongue);
  lopsided.effects["extra_muscle"]["force"] = 0.3;
  ConditionSet set(lopsided, seen, all);
  SharedPrior shared;
  shared.parameters[{"extra_muscle", "force"}] = {0.3, 0.001};
  const JointFit after = fit(set, shared, nullptr, {.start = before.conditions});
  ASSERT_EQ(after.conditions.size(), all.size()) << after.message;
  const Refinement again(symmetric_part(lopsided, {pull}), refinement);
  const Corrections corrections = again.corrections(set, after).corrections;
  for (size_t k = 0; k < all.size(); ++k) {
    ASSERT_EQ(corrections[k].added.size(), expected[k].added.size());
    EXPECT_LT((corrections[k].added - expected[k].added).norm(), 0.3 * expected[k].added.norm())
        << k;
  }
}

TEST_F(RefinementTest, StaysAsItWasAndAnotherKnowsTheCorrections) {
  Observations seen = observed(tongue, true);
  seen.conditions.resize(1);
  ConditionSet set(tongue, seen, {0});
  const JointFit f = fit(set, {}, nullptr);
  ASSERT_TRUE(f.converged) << f.message;
  const Refinement refinement(tongue, seen);
  const auto [corrections, after] = refinement.corrections(set, f);
  EXPECT_FALSE(refinement.holds(set, f));
  EXPECT_TRUE(after.holds(set, f));
  EXPECT_EQ(after.corrections(set, f).corrections[0].added, corrections[0].added);
}

}  // namespace
}  // namespace genio
