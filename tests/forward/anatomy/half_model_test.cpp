// Half a tongue takes the shape that the whole one takes under symmetric commands.

#include "forward/model/half_model.hpp"

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "forward/model/mirror.hpp"
#include "forward/statics/equilibrium.hpp"
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

TEST(HalfModel, TakesTheShapeOfTheWholeUnderEveryEffectThatIsAlikeOnBothSides) {
  const ModelDescription plain = read_description(test::generic_model());
  const Vec3 root = plain.mesh.nodes[size_t(plain.landmarks.root)];
  const std::map<std::string, EffectTable> effects = {
      {"gravity", {{"z", -9.81}}},
      {"active_stiffening", {{"factor", 20}}},
      {"fibre_anisotropy", {{"modulus", 1e5}}},
      {"material_nonlinearity", {{"a20", 3e3}}},
      {"compressibility", {{"compliance", 3e-5}}},
      {"mucosa_layer", {{"a10", 8e3}}},
      {"stiff_region",
       {{"factor", 5}, {"x", root[0] + 0.02}, {"y", 0}, {"z", root[2]}, {"radius", 0.016}}},
      {"weak_muscle", {{"GGP_L", 0.5}, {"GGP_R", 0.5}}},
      {"extra_muscle",
       {{"from_x", root[0] + 0.04},
        {"from_z", root[2] - 0.01},
        {"to_x", root[0]},
        {"to_z", root[2]},
        {"force", 0.5}}},
      {"force_length", {{"strength", 0.5}}},
      {"jaw_opening", {{"angle", 3}}},
      {"hyoid_mobility", {{"compliance_z", 3e-3}, {"stiffness_xy", 200}}},
      {"airway_pressure", {{"pressure", 200}}}};
  for (const auto& [name, table] : effects) {
    ModelDescription d = plain;
    d.effects[name] = table;
    const Model m = build_model(d, name), half = build_model(half_of(d, name), name + ", half");
    Parameters p = default_parameters(m), q = default_parameters(half);
    set_command(m, "GGP", 2, p), set_command(half, "GGP", 1, q);
    Workspace ws(m), half_ws(half);
    const auto both = solve_equilibrium(m, p, m.rest, ws),
               one = solve_equilibrium(half, q, half.rest, half_ws);
    ASSERT_TRUE(both && one) << name;
    for (size_t i = 0; i < m.midsagittal.size(); ++i)
      EXPECT_LT(
          (node_position(both.x, m.midsagittal[i]) - node_position(one.x, half.midsagittal[i]))
              .norm(),
          3e-5)
          << name;
    EXPECT_TRUE(mirror_of(m)) << name;
  }
}

TEST(Mirror, UnfoldsTheHalfIntoTheWhole) {
  const Model m = read_model(test::generic_model());
  const auto mirror = mirror_of(m, {"elasticity.a10"});
  ASSERT_TRUE(mirror);
  EXPECT_LT((mirror->whole(mirror->half.rest) - m.rest).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(mirror->right_half(m.rest), mirror->half.rest);
  Parameters p = default_parameters(m), q = default_parameters(mirror->half);
  set_command(m, "GGP", 3, p), set_command(mirror->half, "GGP", 1.5, q);
  Workspace ws(m), half_ws(mirror->half);
  const auto both = solve_equilibrium(m, p, m.rest, ws),
             one = solve_equilibrium(mirror->half, q, mirror->half.rest, half_ws);
  EXPECT_LT((mirror->whole(one.x) - both.x).cwiseAbs().maxCoeff(), 2e-5);
}

TEST(Mirror, IsRefusedToATongueWithASideOfItsOwn) {
  const ModelDescription d = read_description(test::generic_model());
  ModelDescription weak = d;
  weak.effects["weak_muscle"] = {{"GGP_L", 0.3}};
  EXPECT_FALSE(mirror_of(build_model(weak, "weak")));
  ModelDescription tilted = d;
  tilted.effects["gravity"] = {{"y", 3.0}};
  EXPECT_FALSE(mirror_of(build_model(tilted, "tilted")));
  // Present but for the parameter that is asked about.
  tilted.effects["gravity"] = {{"y", 0.0}};
  EXPECT_TRUE(mirror_of(build_model(tilted, "upright")));
  EXPECT_FALSE(mirror_of(build_model(tilted, "upright"), {"gravity.y"}));
  ModelDescription bent = d;
  bent.mesh.nodes[10][0] += 1e-4;
  EXPECT_FALSE(mirror_of(build_model(bent, "bent")));
}

TEST(Mirror, IsGivenToEffectsThatAreAlikeOnBothSides) {
  ModelDescription d = read_description(test::generic_model());
  d.effects["weak_muscle"] = {{"GGP_L", 0.3}, {"GGP_R", 0.3}};
  d.effects["jaw_opening"] = {{"angle", 2}};
  EXPECT_TRUE(mirror_of(build_model(d, "weak, its jaw open")));
}

TEST(HalfModel, RefusesATongueThatIsNotItsMirrorImage) {
  ModelDescription d = read_description(test::generic_model());
  for (Vec3& x : d.mesh.nodes) x[1] += 1e-3;
  EXPECT_THROW(half_of(d, "shifted"), InputError);
}

}  // namespace
}  // namespace genio
