#include "bench/figures/discover_table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "bench/figures/discover.hpp"

namespace genio::bench {
namespace {

/// A run in which `hidden` was hidden ("": nothing) and `named` was named ("": nothing).
Json result(const std::string& hidden, const std::string& named, double strength, bool known) {
  Json answer = {{"forces_known", known}, {"strength", strength}, {"hidden", Json::array()}};
  if (!hidden.empty())
    answer["hidden"].push_back(
        {{"effect", hidden}, {"in_library", hidden != "lump"}, {"parameters", {{"z", -9.81}}}});
  Json found = {{"verdict", named.empty() ? "none" : "named"},
                {"effects", Json::array()},
                {"rivals", Json::array()},
                {"cpu_s", 10.0},
                {"scoring_s", 1.0},
                {"heldout_excess_before_mm", 0.4},
                {"heldout_excess_after_mm", 0.1}};
  if (!named.empty())
    found["effects"].push_back({{"effect", named}, {"parameters", {{"z", {-9.7, -10.0, -9.0}}}}});
  return {{"case", "x"}, {"answer", answer}, {"found", found}};
}

TEST(DiscoverCases, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const HiddenCase& c : discover_cases()) EXPECT_TRUE(names.insert(c.name).second) << c.name;
}

TEST(DiscoverFigures, AreFractionsOfTheCasesOfTheirKind) {
  const Json j = discover_figures({result("gravity", "gravity", 1, true),
                                   result("gravity", "stiff_region", 1, true),
                                   result("gravity", "gravity", 0.5, true), result("", "", 0, true),
                                   result("", "gravity", 0, true), result("lump", "", 1, true),
                                   result("gravity", "gravity", 1, false)});
  EXPECT_EQ(j["named_known"], 0.5);
  EXPECT_EQ(j["named_unknown"], 1.0);
  EXPECT_EQ(j["false_alarm"], 0.5);
  EXPECT_EQ(j["foreign_named"], 0.0);
  EXPECT_EQ(j["forces_known"]["named_strength_05"], 1.0);
  EXPECT_EQ(j["forces_known"]["parameter_coverage90"], 1.0);
  EXPECT_NEAR(j["heldout_gap_reduction"].get<double>(), 0.75, 1e-12);
  EXPECT_EQ(j["seconds_per_run"], 10.0);
  EXPECT_EQ(j["runs"], 7);
  EXPECT_EQ(j["forces_known"]["confusion"]["gravity"]["named: stiff_region"], 1);
}

TEST(DiscoverFigures, AreNullWhereThereIsNoCase) {
  const Json j = discover_figures({});
  EXPECT_TRUE(j["named_known"].is_null());
  EXPECT_TRUE(j["false_alarm"].is_null());
  EXPECT_EQ(j["runs"], 0);
}

TEST(DiscoverFigures, CountWhatFailedApart) {
  Json error = result("gravity", "gravity", 1, true);
  error["error"] = "no equilibrium";
  const Json failed = {{"case", "gravity-1-known-1-1"}, {"answer", {{"failed", "out of reach"}}}};
  const Json j = discover_figures({error, failed});
  EXPECT_EQ(j["forces_known"]["errors"], 1);
  EXPECT_EQ(j["forces_known"]["out_of_reach"], 1);
  EXPECT_EQ(j["forces_unknown"]["out_of_reach"], 0);
  EXPECT_EQ(j["forces_known"]["cases_strength_1"], 0);
}

}  // namespace
}  // namespace genio::bench
