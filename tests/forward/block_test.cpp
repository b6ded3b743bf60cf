// The block that CalculiX, FEBio, deal.II and FEniCSx were run on.

#include "bench/problems/block.hpp"

#include <gtest/gtest.h>

#include "forward/statics/equilibrium.hpp"

namespace genio {
namespace {

TEST(Block, MeetsTheReferenceDisplacement) {
  const Model m = bench::block(1);
  Workspace ws(m);
  const auto e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
  ASSERT_TRUE(e) << e.message;
  const int top = bench::top_centre(1);
  const Vec3 u = 1e3 * (node_position(e.x, top) - node_position(m.rest, top));
  EXPECT_NEAR(u[0], 36.43, 0.005 * 36.43);
  EXPECT_NEAR(u[1], 0, 1e-6);
  EXPECT_NEAR(u[2], -4.93, 0.005 * 36.43);
  // A straight Newton path turns indefinite on the way and needs fifty.
  EXPECT_LE(e.factorizations, 12);
}

}  // namespace
}  // namespace genio
