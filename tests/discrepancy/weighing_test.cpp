// Candidates are chosen and weighed by their log odds.

#include "discrepancy/contest/weighing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <tuple>

namespace genio {
namespace {

RankedCandidate scored_as(const std::string& effect, const std::string& where, double log_odds) {
  RankedCandidate r;
  r.candidate.effect = effect, r.candidate.where = where;
  r.log_odds = log_odds, r.score.log_evidence = log_odds + 3, r.score.visible = true;
  return r;
}

TEST(Priors, GiveHalfToNothingAndEqualPartsToEveryEffectAndItsPlaces) {
  const std::vector<Candidate> all = {
      {"stiff_region", "tip", {}, {}}, {"gravity", "", {}, {}}, {"stiff_region", "root", {}, {}}};
  const auto prior = log_prior(all);
  ASSERT_EQ(prior.size(), 3u);
  EXPECT_NEAR(std::exp(prior[1]), 0.25, 1e-12);
  EXPECT_NEAR(std::exp(prior[0]), 0.125, 1e-12);
  EXPECT_EQ(prior[0], prior[2]);
}

TEST(Choice, TakesTheLikeliestAndAtMostTwoOfOneEffect) {
  const std::vector<RankedCandidate> all = {
      scored_as("stiff_region", "tip", 20), scored_as("stiff_region", "root", 30),
      scored_as("stiff_region", "dorsum", 25), scored_as("gravity", "", 10)};
  EXPECT_EQ(worth_a_refit(all, 5), (std::vector<size_t>{1, 2, 3}));
  EXPECT_EQ(worth_a_refit(all, 2), (std::vector<size_t>{1, 2}));
  EXPECT_TRUE(worth_a_refit({}, 5).empty());
}

// An open jaw of score 36 was left out once, as the head pose of score 37 had gained 97 by its
// refit.
TEST(WorthARefit, IsHeldAgainstTheScoreInFrontNotAgainstWhatItsRefitGained) {
  EXPECT_FALSE(promises_too_little(36, 37, 97));
  EXPECT_TRUE(promises_too_little(36, 97, 97));
  EXPECT_FALSE(promises_too_little(36, 97, 37));  // a refit that gained little bars nobody
  EXPECT_FALSE(promises_too_little(5, 0, 0));
}

TEST(Choice, LeavesOutWhatTheDataDoNotSeeAndWhatIsFarBehind) {
  std::vector<RankedCandidate> all = {scored_as("gravity", "", 50), scored_as("jaw_opening", "", 1),
                                      scored_as("airway_pressure", "", 40)};
  EXPECT_EQ(worth_a_refit(all, 5), (std::vector<size_t>{0, 2}));  // 1 is below 0.2 x 50 - 5
  all[2].score.visible = false;
  EXPECT_EQ(worth_a_refit(all, 5), (std::vector<size_t>{0}));
  all[0].score.log_evidence = 0;
  EXPECT_TRUE(worth_a_refit(all, 5).empty());
}

TEST(Scoring, AddsTheBeliefToTheEvidenceAndKeepsTheOrder) {
  const std::vector<Candidate> all = {{"gravity", "", {}, {}}, {"jaw_opening", "", {}, {}}};
  Score first, second;
  first.candidate = 1, first.log_evidence = 7, second.candidate = 0, second.log_evidence = 4;
  const auto ranked = as_scored(all, {first, second}, {-1, -2});
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_EQ(ranked[0].candidate.effect, "jaw_opening");
  EXPECT_EQ(ranked[0].log_odds, 5);
  EXPECT_EQ(ranked[1].log_odds, 3);
  EXPECT_EQ(ranked[1].log_prior, -1);
  EXPECT_FALSE(ranked[0].refitted);
}

TEST(Weighing, OfNoRivalsLeavesNothingCertain) {
  EXPECT_EQ(weigh({}).nothing, 1);
  EXPECT_TRUE(weigh({}).probabilities.empty());
}

TEST(Weighing, ProbabilitiesAreInProportionToTheOddsAndSumToOne) {
  const Weights w = weigh({std::log(2.0), std::log(0.25), 0});
  EXPECT_NEAR(w.nothing + std::reduce(w.probabilities.begin(), w.probabilities.end()), 1, 1e-12);
  EXPECT_NEAR(w.probabilities[0] / w.nothing, 4, 1e-12);  // of which nothing has one half
  EXPECT_NEAR(w.probabilities[2] / w.probabilities[1], 4, 1e-12);
  EXPECT_EQ(w.likeliest, 0u);
}

TEST(Weighing, HoldsForOddsThatNoExponentialHolds) {
  const Weights w = weigh({5000, 5001});
  EXPECT_EQ(w.nothing, 0);
  EXPECT_NEAR(w.probabilities[1] / w.probabilities[0], std::exp(1), 1e-9);
  EXPECT_EQ(w.likeliest, 1u);
}

TEST(Ranking, PutsTheLikeliestFirstAndTheUnlikelyByTheirOdds) {
  std::vector<RankedCandidate> candidates;
  for (const auto& [name, odds, probability] :
       {std::tuple("scored best", 5.0, 0.0), std::tuple("second", 124.0, 0.06),
        std::tuple("far behind", 9.0, 0.0), std::tuple("first", 127.0, 0.94)}) {
    RankedCandidate r;
    r.candidate.effect = name, r.log_odds = odds, r.probability = probability;
    candidates.push_back(std::move(r));
  }
  std::vector<std::string> order;
  for (const RankedCandidate& r : ranked(candidates)) order.push_back(r.candidate.effect);
  EXPECT_EQ(order, (std::vector<std::string>{"first", "second", "far behind", "scored best"}));
}

}  // namespace
}  // namespace genio
