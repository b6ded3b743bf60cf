#include "inverse/search/multi_start.hpp"

#include <gtest/gtest.h>

#include "inverse/search/mixed_optima.hpp"
#include "inverse/shape/acting_posterior.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class MultiStart : public test::PulledTongue {
 protected:
  InferWorkspace all{m};
};

TEST_F(MultiStart, AtlasHoldsEquilibriaOfItsCommands) {
  AtlasCache cache;
  const Atlas& atlas = cache.get(m, Prior{}, true, ws);
  EXPECT_GT(atlas.entries.size(), 25u);
  const auto unknowns = unknowns_of(m, Prior{}, true);
  for (const auto& e : {atlas.entries[1], atlas.entries.back()}) {
    const Parameters p = apply_unknowns(unknowns, e.unknowns, default_parameters(m));
    EXPECT_LT(m.dofs.reduce(force(m, e.shape, p)).norm(), 1e-7 * load_size(m, e.shape, p));
  }
  EXPECT_EQ(&atlas, &cache.get(m, Prior{}, true, ws));
  Prior fixed;
  fixed.fixed["SL"] = 1;
  for (const auto& e : cache.get(m, fixed, true, ws).entries)
    EXPECT_NEAR(apply_unknowns(unknowns, e.unknowns,
                               default_parameters(m))[command_parameters(m, "SL").front()],
                1, 1e-9);
}

TEST_F(MultiStart, AWorkspaceServesCopiesOfItsModelAndNoOther) {
  const Target t = pulled({{"GGP", 3}});
  InferOptions once;
  once.max_iterations = 1;
  const Model copy = m, other(m.parts());
  EXPECT_NO_THROW(infer_from_starts(copy, t, Prior{}, all, once, {1}));
  EXPECT_THROW(infer_from_starts(other, t, Prior{}, all, once, {1}), std::invalid_argument);
}

TEST_F(MultiStart, AWorkspaceOutlivesItsModel) {
  std::optional<Model> model(m.parts());
  InferWorkspace own(*model);
  const Model copy = *model;
  model.reset();
  InferOptions once;
  once.max_iterations = 1;
  EXPECT_NO_THROW(infer_from_starts(copy, pulled({{"GGP", 3}}), Prior{}, own, once, {1}));
}

// Once it read `converged`, as if nothing had been left undone.
TEST_F(MultiStart, ASearchCutAfterAWholeDescentIsADeadlineWithIntervals) {
  Target far = curve_target(m, m.rest, 30, 3e-4);
  for (auto& p : far.curve) p.position += Vec2(-0.012, -0.012);
  int starts = 0;
  InferOptions cut;
  cut.progress = [&](int step, double) { starts += step == 0; };
  cut.cancelled = [&] { return starts > 3; };  // the first has a rough descent and a fine one
  std::vector<double> told;
  cut.improved = [&](const Answer& a) { told.push_back(double(a.shape.size())); };
  const Answer a = infer_from_starts(m, far, Prior{}, all, cut);
  EXPECT_EQ(a.status, InferStatus::cancelled) << a.message;
  EXPECT_NE(a.message.find("starts"), std::string::npos) << a.message;
  EXPECT_NE(a.verdict, Verdict::none);
  for (const Estimate& e : a.muscles) EXPECT_TRUE(std::isfinite(e.high)) << e.name;
  // What is told along is of the whole tongue, though half of it is solved.
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front(), double(m.rest.size()));
}

TEST_F(MultiStart, ADeadlineBeforeTheFirstStartIsADeadline) {
  InferOptions soon;
  soon.deadline_s = 1e-9;
  InferWorkspace fresh(m);
  const Answer a = infer_from_starts(m, pulled({{"GGP", 3}}), Prior{}, fresh, soon);
  EXPECT_EQ(a.status, InferStatus::deadline) << a.message;
}

// From rest the descent once ended with IL at its maximum instead of SL curling the tip.
TEST_F(MultiStart, ACurledTipIsNotTakenForItsOpposite) {
  const Target t = pulled({{"SL", 5.2}, {"HG", 1.6}, {"GGP", 3.3}});
  const Answer a = infer_from_starts(m, t, Prior{}, all);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  EXPECT_EQ(a.verdict, Verdict::explained) << a.message;
  EXPECT_LT(1e3 * a.rms, 0.2);
  for (const auto& c : a.muscles) {
    if (c.name == "SL") {
      EXPECT_NEAR(c.best, 5.2, 1.0);
    } else if (c.name == "IL") {
      EXPECT_LT(c.best, 2);
    }
  }
}

TEST_F(MultiStart, HalfATongueAnswersAsTheWhole) {
  const Target t = pulled({{"GGP", 3}, {"TRANS", 2}, {"HG", 1}});
  ASSERT_TRUE(all.half(Prior{}));
  const Answer half = infer_from_starts(m, t, Prior{}, all, {}, {1});
  AtlasCache cache;
  const Atlas& atlas = cache.get(m, Prior{}, true, ws);
  InferOptions from;
  const auto* start = nearest(atlas, Comparison(m, t), unknowns_of(m, Prior{}, true),
                              prior_terms(Prior{}, unknowns_of(m, Prior{}, true)))
                          .front();
  from.start = start->unknowns, from.start_shape = start->shape;
  const Answer whole = infer(m, t, Prior{}, ws, from);
  ASSERT_EQ(whole.status, InferStatus::converged) << whole.message;
  ASSERT_EQ(half.muscles.size(), whole.muscles.size());
  for (size_t i = 0; i < half.muscles.size(); ++i) {
    const auto &a = half.muscles[i], &b = whole.muscles[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_NEAR(a.maximum, b.maximum, 1e-9);
    EXPECT_NEAR(a.best, b.best, 0.05 * b.sd + 1e-3 * b.maximum) << a.name;
    // Up to the noise of thousands of samples.
    EXPECT_NEAR(a.acts, b.acts, 0.02) << a.name;
    EXPECT_NEAR(a.sd, b.sd, 0.15 * b.sd) << a.name;
    EXPECT_NEAR(a.high, b.high, 0.5 * b.sd + 2e-3 * b.maximum) << a.name;
  }
  EXPECT_LT((half.shape - whole.shape).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(half.shape_by_unknown.rows(), m.rest.size());
}

TEST_F(MultiStart, WeightsOfAllOptimaAddUp) {
  const Target t = pulled({{"GGP", 3}, {"TRANS", 2}});
  const Answer a = infer_from_starts(m, t, Prior{}, all, {}, {4});
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  double sum = a.weight;
  for (const auto& other : a.alternatives) {
    sum += other.weight;
    EXPECT_LE(other.weight, a.weight);
    EXPECT_GE(other.weight, 0.01);
  }
  EXPECT_LE(sum, 1 + 1e-12);
  EXPECT_GT(sum, 0.9);
}

TEST_F(MultiStart, EstimatesHoldMixedOptimaByTheirWeights) {
  const auto unknowns = muscle_unknowns(m, true);
  const PriorTerms terms = prior_terms(Prior{}, unknowns);
  const Answer one = infer(m, pulled({{"GGP", 3}}), Prior{}, ws),
               other = infer(m, pulled({{"STY", 3}}), Prior{}, ws);
  Answer light = one, mixed = one;
  light.weight = 0.97, mixed.weight = 0.54;
  mix_optima(unknowns, terms, {{0.03, &other}}, light);
  EXPECT_EQ(light.mixed_optima, 1);
  EXPECT_EQ(light.muscles[0].mean, one.muscles[0].mean);
  mix_optima(unknowns, terms, {{0.36, &other}, {0.04, &one}}, mixed);  // the last is too light
  EXPECT_EQ(mixed.mixed_optima, 2);
  EXPECT_NEAR(mixed.posterior->samples.weights.sum(), 1, 1e-12);
  for (size_t i = 0; i < mixed.muscles.size(); ++i) {
    const Estimate &e = mixed.muscles[i], &a = one.muscles[i], &b = other.muscles[i];
    EXPECT_NEAR(e.acts, 0.6 * a.acts + 0.4 * b.acts, 1e-9) << e.name;
    EXPECT_NEAR(e.mean, 0.6 * a.mean + 0.4 * b.mean, 1e-9 * e.maximum) << e.name;
    EXPECT_EQ(e.best, a.best);
    EXPECT_EQ(e.at_lower, a.at_lower);
    EXPECT_EQ(e.multiplier, a.multiplier);
  }
}

TEST_F(MultiStart, AHeadPoseTakesNoNewAtlas) {
  AtlasCache cache;
  cache.get(m, Prior{}, true, ws);
  Prior posed;
  posed.head_pose = HeadPosePrior{1e-3, 0.02};
  const int before = ws.cholesky.factorizations();
  const Atlas& atlas = cache.get(m, posed, true, ws);
  EXPECT_EQ(ws.cholesky.factorizations(), before);
  const Atlas own = make_atlas(m, posed, true, ws);
  EXPECT_EQ(atlas.names, own.names);
  EXPECT_EQ(atlas.lower, own.lower);
  EXPECT_EQ(atlas.upper, own.upper);
  ASSERT_EQ(atlas.entries.size(), own.entries.size());
  for (size_t k = 0; k < own.entries.size(); ++k) {
    EXPECT_EQ(atlas.entries[k].unknowns, own.entries[k].unknowns);
    EXPECT_LT((atlas.entries[k].shape - own.entries[k].shape).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((atlas.entries[k].by_unknown - own.entries[k].by_unknown).norm(),
              1e-6 * own.entries[k].by_unknown.norm());
  }
  EXPECT_EQ(&atlas, &cache.get(m, posed, true, ws));
}

TEST(AtlasOfAHeadPose, IsNeverThatOfAnotherPrior) {
  const Model block = test::small_model();
  Workspace ws(block);
  const auto fixed = [](int tenths, bool posed) {
    Prior prior;
    prior.fixed["GGP_L"] = 0.1 * tenths;
    if (posed) prior.head_pose = HeadPosePrior{1e-3, 0.02};
    return prior;
  };
  // After so many others the first one is forgotten, and its place in memory may be used again.
  for (int others = 1; others < 8; ++others) {
    AtlasCache cache;
    cache.get(block, fixed(1, true), false, ws);
    for (int k = 0; k < others; ++k) cache.get(block, fixed(2 + k, false), false, ws);
    const double last = 0.1 * (1 + others) / block.muscles[0].max_force;
    EXPECT_NEAR(cache.get(block, fixed(1 + others, true), false, ws).entries.at(0).unknowns[0],
                last, 1e-9)
        << others;
  }
}

}  // namespace
}  // namespace genio
