// Half a tongue takes the shape that the whole one takes under symmetric commands.

#include "forward/half_model.hpp"

#include <gtest/gtest.h>

#include "forward/equilibrium.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(HalfModel, TakesTheShapeOfTheWhole) {
  const ModelDescription whole = read_description(test::generic_model());
  const Model m = build_model(whole, "generic"),
              half = build_model(half_of(whole, "generic"), "half");
  for (const auto& forces : {std::vector<std::pair<std::string, double>>{{"GGP", 3}, {"SL", 0.6}},
                             {{"HG", 4}, {"TRANS", 1}},
                             {{"GGP", 14}, {"STY", 8}}}) {  // meets the palate
    Parameters p = default_parameters(m), q = default_parameters(half);
    for (const auto& [name, newtons] : forces)
      set_command(m, name, newtons, p), set_command(half, name, newtons / 2, q);
    Workspace ws(m), half_ws(half);
    const auto both = solve_equilibrium(m, p, m.rest, ws),
               one = solve_equilibrium(half, q, half.rest, half_ws);
    ASSERT_TRUE(both) << both.message;
    ASSERT_TRUE(one) << one.message;
    EXPECT_EQ(max_penetration(m, both.x, p) > 1e-6, max_penetration(half, one.x, q) > 1e-6);
    for (size_t i = 0; i < m.midsagittal.size(); ++i)
      EXPECT_LT(
          (node_position(both.x, m.midsagittal[i]) - node_position(one.x, half.midsagittal[i]))
              .norm(),
          2e-5);
  }
}

TEST(HalfModel, RefusesATongueThatIsNotItsMirrorImage) {
  ModelDescription d = read_description(test::generic_model());
  for (Vec3& x : d.mesh.nodes) x[1] += 1e-3;
  EXPECT_THROW(half_of(d, "shifted"), InputError);
}

}  // namespace
}  // namespace genio
