// Points of the head that a file names are read beside the tongue, and never as its points.

#include "inverse/recording/base/head_points.hpp"

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

using enum HeadPoint;

TEST(HeadPoints, AreNamedInAnySpelling) {
  for (const char* name : {"hyoid", "Hyoid", "DLC_Hyoid", "hyoid_bone", "HYOID 1"})
    EXPECT_EQ(head_points_in(name), std::vector{hyoid}) << name;
  for (const char* name : {"mandible", "DLC_Mandible", "jaw", "Jaw_Shadow"})
    EXPECT_EQ(head_points_in(name), std::vector{mandible}) << name;
  for (const char* name : {"shortTendon", "short_tendon", "DLC_ShortTendon", "Shorttendon"})
    EXPECT_EQ(head_points_in(name), std::vector{short_tendon}) << name;
  EXPECT_EQ(head_points_in("DLC_HyoidMandible"), (std::vector{hyoid, mandible}));
  EXPECT_EQ(head_points_in("DLC_ShorttendonMandible"), (std::vector{short_tendon, mandible}));
  for (const char* name : {"", "DLC_Tongue", "geniohyoid", "thyroid1", "jawline tongue", "Roof"})
    EXPECT_TRUE(head_points_in(name).empty()) << name;
}

const std::string aaa_titles =
    "Client family name\tTime of sample in recording\tPrompt\tX0 DLC_Tongue\tY0 DLC_Tongue\t"
    "X1 DLC_Tongue\tY1 DLC_Tongue\tX2 DLC_Tongue\tY2 DLC_Tongue\t"
    "X0 DLC_HyoidMandible\tY0 DLC_HyoidMandible\tX1 DLC_HyoidMandible\tY1 DLC_HyoidMandible\t"
    "X0 DLC_ShorttendonMandible\tY0 DLC_ShorttendonMandible\tX1 DLC_ShorttendonMandible\t"
    "Y1 DLC_ShorttendonMandible\n";

TEST_F(Formats, SplinesOfTwoBonesGiveEachItsPoint) {
  const auto f = read_contours(
      write("a.tsv", aaa_titles + "S\t0.1\tata\t40\t60\t60\t70\t80\t60\t44\t21\t87\t23\t86\t31\t87"
                                  "\t23\nS\t0.2\tata\t40\t60\t60\t70\t80\t60\t*\t*\t*\t*\t86\t32\t"
                                  "88\t24\n"));
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[0].points.size(), 3u);
  EXPECT_EQ(f.head_points.at(hyoid), (std::vector{Vec2(44, 21)}));
  EXPECT_EQ(f.head_points.at(mandible), (std::vector{Vec2(87, 23), Vec2(88, 24)}));
  EXPECT_EQ(f.head_points.at(short_tendon), (std::vector{Vec2(86, 31), Vec2(86, 32)}));
}

TEST_F(Formats, KnotsOfTheHeadThatTheTrackerDoubtsAreLeftOut) {
  const std::string of = " of spline \"";
  std::string titles = "Prompt", row = "ata";
  for (const char* spline : {"Tongue\"", "Hyoid\""})
    titles += "\tNumber of points" + of + spline + "\tX,Y values" + of + spline +
              "\tConfidence values" + of + spline;
  const auto rows = [&](int confidence) {
    return fmt::format("ata\t3\t40\t60\t60\t70\t80\t60\t90\t90\t90\t1\t44\t21\t{}\n", confidence);
  };
  const auto f = read_contours(write("b.tsv", titles + "\n" + rows(90) + rows(20) + rows(80)));
  EXPECT_EQ(f.frames.at(0).points.size(), 3u);
  EXPECT_EQ(f.head_points.at(hyoid), (std::vector{Vec2(44, 21), Vec2(44, 21)}));
}

std::string body_part_table(const std::vector<std::string>& parts, double doubtful) {
  std::string text = "scorer", bodies = "bodyparts", coords = "coords", rows;
  for (const std::string& part : parts)
    text += ",D,D,D", bodies += "," + part + "," + part + "," + part, coords += ",x,y,likelihood";
  for (int r = 0; r < 3; ++r) {
    rows += fmt::format("{}", r);
    for (size_t k = 0; k < parts.size(); ++k)
      rows += fmt::format(",{},{},{}", 110 + 40 * int(k), 150 - 10 * int(k),
                          r == 1 && k + 1 == parts.size() ? doubtful : 0.95);
    rows += "\n";
  }
  return text + "\n" + bodies + "\n" + coords + "\n" + rows;
}

TEST_F(Formats, BodyPartsOfTheHeadAreNoPointsOfTheTongue) {
  ReadOptions o;
  o.mm_per_px = 0.3;
  for (const char* prefix : {"tongue", "", "DLC_"}) {
    SCOPED_TRACE(prefix);
    std::vector<std::string> parts;
    for (const char* part : {"Root", "Body", "Tip"}) parts.push_back(prefix + std::string(part));
    parts.insert(parts.end(), {"mandible", "shortTendon", "DLC_Hyoid"});
    const auto f = read_contours(write("d.csv", body_part_table(parts, 0.3)), o);
    EXPECT_EQ(f.frames.at(0).points.size(), 3u);
    EXPECT_EQ(f.head_points.at(mandible).size(), 3u);
    EXPECT_EQ(f.head_points.at(short_tendon).size(), 3u);
    EXPECT_EQ(f.head_points.at(hyoid), (std::vector{Vec2(310, 100), Vec2(310, 100)}));
  }
  o.spline = "DLC";
  const auto f = read_contours(
      write("e.csv", body_part_table({"DLC_a", "DLC_b", "DLC_c", "DLC_Hyoid"}, 0.9)), o);
  EXPECT_EQ(f.frames.at(0).points.size(), 3u);
}

}  // namespace
}  // namespace genio
