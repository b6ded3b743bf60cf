#include "report/discovery/discovery_page.hpp"

#include "report/discovery/discovery_pictures.hpp"
#include "tests/report/markup.hpp"

namespace genio {
namespace {

class DiscoveryPage : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"i", "a <low>"}) observations.conditions.emplace_back().name = name;
    observations.conditions[0].target.curve = {{{0.08, 0.11}, 5e-4}, {{0.09, 0.12}, 5e-4}};
    auto& round = discovery.rounds.emplace_back();
    for (const char* name : names) {
      auto& ranked = round.candidates.emplace_back();
      ranked.candidate.effect = name, ranked.score.visible = true;
      ranked.log_odds = 10 - 3 * double(round.candidates.size());
    }
    round.candidates.front().refitted = true;
    auto& named = discovery.effects.emplace_back();
    named.effect = "gravity", named.confidence = 0.875;
    discovery.alternatives.emplace_back().effect = "extra_muscle";
    discovery.message = "explains what is left & more";
    discovery.noise = 4e-4;
    for (size_t i = 0; i < 2; ++i) {
      discovery.lines_before.push_back({i, {{0.07, 0.1}, {0.08, 0.11}, {0.09, 0.1}}});
      discovery.map_before.points.push_back({i, {0.08, 0, 0.11}, 1e-3, 3, true, "dorsum"});
    }
    discovery.map_after = discovery.map_before, discovery.lines_after = discovery.lines_before;
  }
  const std::vector<const char*> names = {"gravity", "extra_muscle", "stiff_region",
                                          "airway_pressure"};
  Observations observations;
  Discovery discovery;
};

TEST_F(DiscoveryPage, IsWellFormedAndNamesEveryCandidate) {
  const std::string page = discovery_page(discovery, observations, "Tongue of <X> & Y");
  pugi::xml_document document;
  test::parse(page, document);
  const auto words = test::texts(document);
  const auto holds = [&](const std::string& part) {
    return std::any_of(words.begin(), words.end(),
                       [&](const auto& w) { return w.find(part) != std::string::npos; });
  };
  for (const char* name : names) EXPECT_TRUE(holds(name)) << name;
  EXPECT_TRUE(holds("Tongue of <X> & Y"));
  EXPECT_TRUE(holds("explains what is left & more"));
  EXPECT_TRUE(holds("a <low>"));
  EXPECT_TRUE(holds("0.875"));
}

TEST_F(DiscoveryPage, RanksCandidatesByBarsDarkWhereRefitted) {
  pugi::xml_document document;
  test::parse(draw_ranking(discovery.rounds[0], 14), document);
  EXPECT_EQ(test::count(document, "rect", "fill", "#1f5fa8"), 1);
  EXPECT_EQ(test::count(document, "rect", "fill", "#a9c3e0"), 3);
  pugi::xml_document fewer;
  test::parse(draw_ranking(discovery.rounds[0], 2), fewer);
  EXPECT_EQ(test::count(fewer, "rect", "fill", "#a9c3e0"), 1);
}

TEST_F(DiscoveryPage, ShowsEveryConditionBeforeAndAfter) {
  pugi::xml_document maps, contours;
  test::parse(draw_maps(discovery, observations), maps);
  test::parse(draw_contours(discovery, observations), contours);
  EXPECT_EQ(test::texts(maps), (std::vector<std::string>{"i, before", "i, after", "a <low>, before",
                                                         "a <low>, after"}));
  EXPECT_EQ(test::texts(contours), (std::vector<std::string>{"i", "a <low>"}));
  EXPECT_EQ(test::count(contours, "circle", "fill", "#c0392b"), 2);  // measured
}

TEST_F(DiscoveryPage, IsWellFormedWhereNothingWasFound) {
  pugi::xml_document document;
  test::parse(discovery_page({}, {}, "Nothing"), document);
}

}  // namespace
}  // namespace genio
