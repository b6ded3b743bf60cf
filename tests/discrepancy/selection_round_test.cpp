// Each step of a round takes values and returns new ones; what it is given stays as it was.

#include "discrepancy/contest/selection_round.hpp"

#include "discrepancy/conditions/influence.hpp"
#include "discrepancy/contest/settled_fit.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

/// A tongue whose jaw is open, seen with the jaw shut.
class SelectionSteps : public test::PosedTongue {
 protected:
  SelectionSteps() {
    ModelDescription open = tongue;
    open.effects["jaw_opening"] = {{"angle", 3}};
    observations = observed(open, true);
    observations.conditions.back().heldout = true;
    options.correct_mesh = false, options.refits = 1;
    null_model = fitted_null_model(tongue, observations, options.error_model, false);
    influences = influences_of(*null_model.model.set, null_model.model.fit);
  }
  SelectionRound first_scores() const {
    const Projection projection(null_model.model.fit, null_model.errors.fitted->covariance);
    return scored(null_model, influences, projection, {});
  }
  Observations observations;
  DiscoverOptions options;
  NullModel null_model;
  std::vector<Matrix> influences;
};

TEST_F(SelectionSteps, ScoreRefitWeighAndAddEachLeaveTheirInputAsItWas) {
  const SelectionRound scores = first_scores();
  ASSERT_FALSE(scores.round.candidates.empty());
  EXPECT_TRUE(scores.contenders.empty());
  EXPECT_EQ(scores.round.chi_square, null_model.model.chi_square);

  const SelectionRound refits = refitted(scores, options);
  ASSERT_EQ(refits.contenders.size(), 1u);
  EXPECT_TRUE(scores.contenders.empty());
  for (const RankedCandidate& r : scores.round.candidates) EXPECT_FALSE(r.refitted);
  const RankedCandidate& best = refits.candidate_of(0);
  EXPECT_EQ(best.candidate.effect, "jaw_opening");
  const ModelFit& with_jaw = refits.contenders[0].model;
  EXPECT_NEAR(best.log_odds,
              with_jaw.log_evidence() - null_model.model.log_evidence() + best.log_prior, 1e-9);
  EXPECT_LT(with_jaw.chi_square, null_model.model.chi_square);

  const SelectionRound odds = weighed(refits);
  EXPECT_EQ(refits.candidate_of(0).probability, 0);
  EXPECT_NEAR(odds.candidate_of(0).probability + odds.round.nothing, 1, 1e-12);
  EXPECT_EQ(odds.candidate_of(0).log_odds, best.log_odds);

  const double before = null_model.model.log_evidence();
  const NullModel again = restarted(null_model, with_jaw, best.candidate);
  EXPECT_GE(again.model.log_evidence(), before);
  const NullModel next = with_winner(null_model, with_jaw, {best.candidate}, options.error_model);
  EXPECT_EQ(null_model.model.log_evidence(), before);
  EXPECT_GT(next.model.log_evidence(), before);
  EXPECT_TRUE(next.model.description.effects.contains("jaw_opening"));
  EXPECT_FALSE(null_model.model.description.effects.contains("jaw_opening"));
  EXPECT_EQ(next.model.heldout.conditions.size(), 1u);
}

TEST_F(SelectionSteps, SettlingMovesAFitLessAndLess) {
  const SettledFit start{null_model.model.fit, null_model.errors.fitted, nullptr};
  const auto again = [&](const SettledFit& from) {
    return settled(*null_model.model.set, {}, from, options.error_model);
  };
  const auto errors = [](const SettledFit& fit) { return fit.errors->matrix.trace(); };
  const SettledFit once = again(start), twice = again(once);
  EXPECT_NEAR(once.fit.value, start.fit.value, 0.05 * start.fit.value);
  EXPECT_LE(std::abs(twice.fit.value - once.fit.value), std::abs(once.fit.value - start.fit.value));
  EXPECT_LE(std::abs(errors(twice) - errors(once)), std::abs(errors(once) - errors(start)));
  EXPECT_EQ(twice.refinement, nullptr);
}

TEST_F(SelectionSteps, WhatWasFoundIsNoCandidateAnyMore) {
  const SelectionRound all = first_scores();
  const Candidate found = all.round.candidates.front().candidate;
  const Projection projection(null_model.model.fit, null_model.errors.fitted->covariance);
  const SelectionRound rest = scored(null_model, influences, projection, {found});
  EXPECT_EQ(rest.round.candidates.size() + 1, all.round.candidates.size());
  for (const RankedCandidate& r : rest.round.candidates)
    EXPECT_NE(r.candidate.label(), found.label());
}

}  // namespace
}  // namespace genio
