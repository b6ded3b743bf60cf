#include "report/pictures/plot.hpp"

#include "tests/report/markup.hpp"

namespace genio {
namespace {

std::vector<Eigen::Vector2d> points_of(const pugi::xml_node& line) {
  std::vector<Eigen::Vector2d> points;
  std::istringstream in(line.attribute("points").value());
  char comma;
  for (Eigen::Vector2d p; in >> p[0] >> comma >> p[1];) points.push_back(p);
  return points;
}

TEST(Plot, DrawsEveryPointOfEverySeriesAndNamesIt) {
  const std::vector<Series> series = {{"first & best", {{1, 1}, {2, 4}, {3, 9}}},
                                      {"second", {{1, 2}, {3, 2}}}};
  pugi::xml_document document;
  test::parse(plot("Title", "x", "y", series, false, false), document);
  std::vector<size_t> counts;
  for (const auto& line : document.child("svg").children("polyline"))
    counts.push_back(points_of(line).size());
  EXPECT_EQ(counts, (std::vector<size_t>{3, 2}));
  const auto words = test::texts(document);
  for (const char* expected : {"Title", "x", "y", "first & best", "second"})
    EXPECT_NE(std::find(words.begin(), words.end(), expected), words.end()) << expected;
}

TEST(Plot, DrawsAPowerLawAsAStraightLineOnLogarithmicAxes) {
  std::vector<Series> series = {{"n^-2", {}}};
  for (double n : {2, 4, 8, 16}) series[0].points.emplace_back(n, 1 / (n * n));
  pugi::xml_document document;
  test::parse(plot("Rate", "n", "error", series, true, true), document);
  const auto p = points_of(document.child("svg").child("polyline"));
  ASSERT_EQ(p.size(), 4u);
  for (size_t i = 2; i < p.size(); ++i) {
    const Eigen::Vector2d first = p[1] - p[0], step = p[i] - p[i - 1];
    EXPECT_NEAR(step[0], first[0], 0.2) << i;  // coordinates are written to 0.1 pixel
    EXPECT_NEAR(step[1], first[1], 0.2) << i;
  }
}

TEST(Plot, IsWellFormedWithoutAnyPoint) {
  pugi::xml_document document;
  test::parse(plot("Nothing", "x", "y", {{"empty", {}}}, false, false), document);
}

}  // namespace
}  // namespace genio
