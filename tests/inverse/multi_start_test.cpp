#include "inverse/multi_start.hpp"

#include <gtest/gtest.h>

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
  const auto commands = unknowns(m, Prior{}, true);
  for (const auto& e : {atlas.entries[1], atlas.entries.back()}) {
    const Parameters p = apply_commands(commands, e.unknowns, default_parameters(m));
    EXPECT_LT(m.dofs.reduce(force(m, e.shape, p)).norm(), 1e-7 * load_size(m, e.shape, p));
  }
  EXPECT_EQ(&atlas, &cache.get(m, Prior{}, true, ws));
  Prior fixed;
  fixed.fixed["SL"] = 1;
  for (const auto& e : cache.get(m, fixed, true, ws).entries)
    EXPECT_NEAR(apply_commands(commands, e.unknowns,
                               default_parameters(m))[command_parameters(m, "SL").front()],
                1, 1e-9);
}

// From rest the descent once ended with IL at its maximum instead of SL curling the tip.
TEST_F(MultiStart, ACurledTipIsNotTakenForItsOpposite) {
  const Target t = pulled({{"SL", 5.2}, {"HG", 1.6}, {"GGP", 3.3}});
  const Answer a = infer_from_starts(m, t, Prior{}, all);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  EXPECT_EQ(a.verdict, Verdict::explained) << a.message;
  EXPECT_LT(1e3 * a.rms, 0.2);
  for (const auto& c : a.commands) {
    if (c.name == "SL") {
      EXPECT_NEAR(c.force, 5.2, 1.0);
    } else if (c.name == "IL") {
      EXPECT_LT(c.force, 2);
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
  const auto* start = nearest(atlas, Comparison(m, t), unknowns(m, Prior{}, true),
                              prior_terms(Prior{}, unknowns(m, Prior{}, true)))
                          .front();
  from.start = start->unknowns, from.start_shape = start->shape;
  const Answer whole = infer(m, t, Prior{}, ws, from);
  ASSERT_EQ(whole.status, InferStatus::converged) << whole.message;
  ASSERT_EQ(half.commands.size(), whole.commands.size());
  for (size_t i = 0; i < half.commands.size(); ++i) {
    const auto &a = half.commands[i], &b = whole.commands[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_NEAR(a.max_force, b.max_force, 1e-9);
    EXPECT_NEAR(a.force, b.force, 0.05 * b.sd + 1e-3 * b.max_force) << a.name;
    EXPECT_NEAR(a.sd, b.sd, 0.05 * b.sd) << a.name;
    EXPECT_NEAR(a.high, b.high, 0.1 * b.sd) << a.name;
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

}  // namespace
}  // namespace genio
