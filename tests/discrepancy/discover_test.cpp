// The whole workflow on data of the model's own mesh, where no mesh error has to be taken off.

#include "discrepancy/contest/discover.hpp"

#include <cmath>
#include <fstream>
#include <tuple>

#include "discrepancy/contest/weighing.hpp"
#include "forward/model/build_model.hpp"
#include "tests/discrepancy/posed_tongue.hpp"

namespace genio {
namespace {

class Discover : public test::PosedTongue {
 protected:
  Discovery found(const ModelDescription& truth) {
    Observations o = observed(truth, true);
    o.conditions.back().heldout = true;
    DiscoverOptions options;
    options.correct_mesh = false, options.refits = 2;
    return discover(tongue, o, options);
  }
};

TEST_F(Discover, NamesNothingWhereNothingIsHidden) {
  const Discovery d = found(tongue);
  EXPECT_EQ(d.verdict, DiscoveryVerdict::none) << d.message;
  EXPECT_TRUE(d.effects.empty());
  EXPECT_TRUE(d.map_before.patches.empty());
}

TEST_F(Discover, NamesAnOpenJawAndTheGapShrinksAlsoWhereItDidNotLook) {
  ModelDescription truth = tongue;
  truth.effects["jaw_opening"] = {{"angle", 3}};
  const Discovery d = found(truth);
  ASSERT_FALSE(d.effects.empty()) << to_string(d.verdict) << ": " << d.message;
  EXPECT_EQ(d.effects[0].effect, "jaw_opening");
  ASSERT_EQ(d.effects[0].parameters.size(), 1u);
  EXPECT_NEAR(d.effects[0].parameters[0].value, 3, 0.3);
  EXPECT_LT(d.after.rms, 0.3 * d.before.rms);
  EXPECT_LT(d.heldout_after.rms, 0.3 * d.heldout_before.rms);
  EXPECT_FALSE(d.map_before.patches.empty());
  EXPECT_TRUE(d.map_after.patches.empty());
  EXPECT_GT(d.hidden.log_evidence, 0);
  EXPECT_NEAR(d.model.effects.at("jaw_opening").at("angle"), 3, 0.3);
}

TEST(Ranking, PutsTheLikeliestFirstAndTheUnlikelyByTheirOdds) {
  Round round;
  for (const auto& [name, odds, probability] :
       {std::tuple("scored best", 5.0, 0.0), std::tuple("second", 124.0, 0.06),
        std::tuple("far behind", 9.0, 0.0), std::tuple("first", 127.0, 0.94)}) {
    RankedCandidate r;
    r.candidate.effect = name, r.log_odds = odds, r.probability = probability;
    round.candidates.push_back(std::move(r));
  }
  rank(round);
  std::vector<std::string> order;
  for (const RankedCandidate& r : round.candidates) order.push_back(r.candidate.effect);
  EXPECT_EQ(order, (std::vector<std::string>{"first", "second", "far behind", "scored best"}));
}

FreeNumber between(double lower, double upper) {
  return {.info = {.lower = lower, .upper = upper}};
}

TEST(Intervals, AreAsWideAsTheErrorModelMakesThem) {
  const SharedEstimate fitted{"e.v", "N", 10, 1, 10 - 1.645, 10 + 1.645};
  const SharedEstimate same = widened(fitted, between(-100, 100), 0);
  EXPECT_DOUBLE_EQ(same.low, fitted.low);
  EXPECT_DOUBLE_EQ(same.high, fitted.high);
  const SharedEstimate wider = widened(fitted, between(-100, 100), 1);
  EXPECT_NEAR(wider.sd, std::sqrt(2), 1e-12);
  EXPECT_NEAR(wider.high - 10, 1.645 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(10 - wider.low, wider.high - 10, 1e-12);
  EXPECT_EQ(widened(fitted, between(9, 10.5), 1).low, 9);
}

TEST(Intervals, AreSkewedAwayFromWhereAnEffectVanishes) {
  const SharedEstimate fitted{"e.v", "N", 10, 3, 10 - 4.9, 10 + 4.9};
  const SharedEstimate up = widened(fitted, between(0, 100), 0);
  EXPECT_NEAR(up.high, 10 * std::exp(0.49), 1e-9);
  EXPECT_NEAR(up.low, fitted.low, 1e-12);
  SharedEstimate mirrored = fitted;
  mirrored.value = -10, mirrored.low = -14.9, mirrored.high = -5.1;
  const SharedEstimate down = widened(mirrored, between(-100, 0), 0);
  EXPECT_NEAR(down.low, -up.high, 1e-9);
  EXPECT_NEAR(down.high, -up.low, 1e-9);
}

TEST(Intervals, OfAFactorAreThoseOfItsLogarithm) {
  FreeNumber number = between(0.05, 100);
  number.info.absent = 1, number.belief.ratio = true;
  const SharedEstimate fitted{"stiff_region.factor", "1", 8, 4, 4, 16};
  const SharedEstimate same = widened(fitted, number, 0);
  EXPECT_NEAR(same.low, 4, 1e-12);
  EXPECT_NEAR(same.high, 16, 1e-12);
  const SharedEstimate wider = widened(fitted, number, 0.1 * std::log(8));
  EXPECT_NEAR(wider.low * wider.high, 64, 1e-9);
  EXPECT_NEAR(std::log(wider.high / 8), std::hypot(std::log(2), 0.1645 * std::log(8)), 1e-9);
}

class ObservationsFile : public testing::Test {
 protected:
  std::string error(const std::string& text) {
    const std::string path = testing::TempDir() + "observations.toml";
    std::ofstream(path) << text;
    try {
      read_observations(path, m);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  const Model m = read_model(test::generic_model());
  const std::string shape =
      std::string("\"") + GENIO_SOURCE_DIR + "/data/examples/example_shape.csv\"";
};

TEST_F(ObservationsFile, ErrorsNameFileLineAndField) {
  const auto expect_says = [&](const std::string& text, const std::vector<std::string>& parts) {
    const std::string e = error(text);
    for (const auto& part : parts) EXPECT_NE(e.find(part), std::string::npos) << e;
  };
  expect_says("noise_mm = 0.4\n", {"observations.toml", "no [[condition]]"});
  expect_says("[[condition]]\nname = \"a\"\n", {"'noise_mm' is missing"});
  expect_says("noise_mm = 0.4\n[[condition]]\nname = \"a\"\ntarget = " + shape +
                  "\nforces_N = { GPP = 1 }\n",
              {":5:", "GPP", "did you mean GGP"});
  expect_says("noise_mm = 0.4\n[[condition]]\nname = \"a\"\ntarget = " + shape +
                  "\neffects = { jaw = 1 }\n",
              {":5", "jaw", "did you mean"});
  expect_says(
      "noise_mm = 0.4\n[[condition]]\nname = \"a\"\ntarget = " + shape + "\nheldout = true\n",
      {"every condition is held out"});
  expect_says("noise_mm = -1\n", {":1:", "noise_mm"});
}

TEST_F(ObservationsFile, KnownForcesAndEffectsAreRead) {
  const std::string path = testing::TempDir() + "good.toml";
  std::ofstream(path) << "noise_mm = 0.4\nforce_sd_percent = 10\n[[condition]]\nname = \"a\"\n"
                         "target = " +
                             shape +
                             "\nforces_N = { GGP = 2.0 }\n"
                             "effects = { jaw_opening = 4.0 }\n";
  const Observations o = read_observations(path, m);
  ASSERT_EQ(o.conditions.size(), 1u);
  const auto& forces = *o.conditions[0].forces;
  EXPECT_NEAR(forces.at("GGP_L").mean, 1, 1e-12);
  EXPECT_NEAR(forces.at("GGP_L").sd, 0.1, 1e-12);
  EXPECT_EQ(o.conditions[0].effects.at("jaw_opening.angle"), 4);
}

}  // namespace
}  // namespace genio
