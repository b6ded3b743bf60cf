// What a model may lack is said by the effects themselves.

#include "forward/model/hypothesis.hpp"

#include <gtest/gtest.h>

#include <set>

#include "forward/model/build_effects.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/effect_kinds.hpp"
#include "forward/model/sums.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

bool makes_unknowns(const std::string& effect) { return find_kind(effect)->support; }

class Hypotheses : public testing::Test {
 protected:
  Hypotheses() {
    bare.effects = {{"elasticity", bare.effects.at("elasticity")}};
    all = hypotheses(bare);
  }
  ModelDescription bare = read_description(test::generic_model());
  std::vector<Hypothesis> all;
};

TEST_F(Hypotheses, EveryEffectIsOneButTissueAndMuscles) {
  std::set<std::string> seen;
  for (const Hypothesis& h : all) seen.insert(h.effect);
  for (const std::string& name : effect_names())
    // Modes of anatomy are hypotheses where the model has some.
    EXPECT_EQ(seen.contains(name), name != "elasticity" && name != "muscles" && name != "anatomy")
        << name;
}

TEST_F(Hypotheses, VanishInTheModelTheyAreAddedTo) {
  const Model without = build_model(bare, "bare");
  Parameters p = default_parameters(without);
  set_command(without, "GGP", 3, p);
  const Positions x = test::shaken(without, 1e-4, 3);
  const Forces f = force(without, x, p);
  for (const Hypothesis& h : all) {
    if (makes_unknowns(h.effect)) continue;
    const Model with = build_model(h.added_to(bare), h.label());
    Parameters q = default_parameters(with);
    set_command(with, "GGP", 3, q);
    EXPECT_LE((force(with, x, q) - f).norm(), 1e-12 * f.norm()) << h.label();
  }
}

TEST_F(Hypotheses, NumbersAreKeysOfTheirTables) {
  for (const Hypothesis& h : all) {
    const auto with = h.added_to(bare);
    const Model m = build_model(with, h.label());
    for (const auto* numbers : {&h.strengths, &h.details})
      for (const FreeNumber& n : *numbers)
        for (const std::string& key : n.keys) {
          EXPECT_NO_THROW(parameter_index(m, h.effect + "." + key)) << h.label();
          EXPECT_GT(n.belief.typical, 0) << h.label();
        }
    EXPECT_FALSE(h.strengths.empty()) << h.label();
  }
}

TEST_F(Hypotheses, ArePlacedWhereThereIsTissue) {
  std::set<std::string> places;
  for (const Hypothesis& h : all)
    if (h.effect == "stiff_region") {
      places.insert(h.where);
      double nearest = 1;
      for (const Vec3& x : bare.mesh.nodes)
        nearest =
            std::min(nearest, (x - Vec3(h.table.at("x"), h.table.at("y"), h.table.at("z"))).norm());
      EXPECT_LT(nearest, 6e-3) << h.where;
    }
  EXPECT_EQ(places,
            (std::set<std::string>{"anterior", "left", "middle", "posterior", "right", "root"}));
}

TEST_F(Hypotheses, ThereIsNoneForAnEffectThatTheModelHas) {
  ModelDescription d = bare;
  d.effects["gravity"] = {{"z", -9.81}};
  d.effects["weak_muscle"] = {{"HG_L", 0.5}};
  std::set<std::string> weak;
  for (const Hypothesis& h : hypotheses(d)) {
    EXPECT_NE(h.effect, "gravity");
    if (h.effect == "weak_muscle") weak.insert(h.where);
  }
  EXPECT_FALSE(weak.contains("HG_L"));
  EXPECT_TRUE(weak.contains("HG_R"));  // other muscles may be weak too
}

TEST_F(Hypotheses, GravityPullsNoUprightHeadUp) {
  for (const Hypothesis& h : all)
    if (h.effect == "gravity") {
      EXPECT_EQ(h.strengths.at(2).info.upper, 0);
      EXPECT_LT(h.strengths.at(2).info.lower, -9.81);
      EXPECT_GT(h.strengths.at(0).info.upper, 9.81);  // on the back
    }
  ModelDescription d = bare;
  d.effects["gravity"] = {{"z", 9.81}};  // a user may
  EXPECT_NO_THROW(build_model(d, "falls upwards"));
}

TEST_F(Hypotheses, GravityIsPlausibleFromUprightToSupineOnly) {
  const auto plausible = [&](double x, double y, double z) {
    const double p[] = {x, y, z, 0};
    return implausible("gravity", p).empty();
  };
  EXPECT_TRUE(plausible(0, 0, -9.81));
  EXPECT_TRUE(plausible(9.81, 0, 0));       // on the back
  EXPECT_TRUE(plausible(-4, 0, -9));        // bowed
  EXPECT_TRUE(plausible(-0.8, 0.6, -0.5));  // too weak to tell where it points
  EXPECT_FALSE(plausible(0, 9.81, 0));      // on a side
  EXPECT_FALSE(plausible(-9.81, 0, -0.5));  // face down
  EXPECT_FALSE(plausible(-2.4, 2.4, 0));
  EXPECT_NE(implausible("gravity", std::array{0.0, 9.0, -9.0, 0.0}).find("45 to a side"),
            std::string::npos);
}

}  // namespace
}  // namespace genio
