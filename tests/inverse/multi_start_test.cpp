#include "inverse/multi_start.hpp"

#include <gtest/gtest.h>

#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class MultiStart : public test::PulledTongue {
 protected:
  AtlasCache cache;
};

TEST_F(MultiStart, AtlasHoldsEquilibriaOfItsCommands) {
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
  const Answer a = infer_from_starts(m, t, Prior{}, ws, cache);
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

TEST_F(MultiStart, WeightsOfAllOptimaAddUp) {
  const Target t = pulled({{"GGP", 3}, {"TRANS", 2}});
  const Answer a = infer_from_starts(m, t, Prior{}, ws, cache, {}, {4});
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
