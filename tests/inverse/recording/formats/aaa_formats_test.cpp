// Exports of AAA: the right spline, whole rows, and knots that are left out only in words.

#include <algorithm>

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

/// Titles and values of a spline whose knots lie `spacing` mm apart on an arch.
struct Spline {
  std::string titles, values;
  Spline(const std::string& name, int knots, double spacing, double up) {
    for (int k = 0; k < knots; ++k) {
      titles += fmt::format("\tX{0} {1}\tY{0} {1}", k, name);
      values += fmt::format("\t{:.3f}\t{:.3f}", 30 - spacing * k, up - 0.01 * k * k);
    }
  }
};

const std::string before = "Client family name\tTime of sample in recording\tPrompt";
const std::string begin = "S1\t0.5\tata";

ReadOptions as(const std::string& role, const std::string& spline = "") {
  ReadOptions o;
  o.role = role, o.spline = spline;
  return o;
}

TEST_F(Formats, AaaTakesTheSplineThatIsNamedForTheRole) {
  const Spline roof("Roof", 21, 3, 80), tongue("dlc_TONGUE", 20, 3, 60), hyoid("Hyoid", 4, 3, 20);
  const auto path = write("a.tsv", before + roof.titles + tongue.titles + hyoid.titles + "\n" +
                                       begin + roof.values + tongue.values + hyoid.values + "\n");
  EXPECT_EQ(read_contours(path).frames[0].points.size(), 20u);
  EXPECT_EQ(read_contours(path, as("palate")).frames[0].points.size(), 21u);
  EXPECT_EQ(read_contours(path, as("tongue", "roof")).frames[0].points.size(), 21u);
  EXPECT_EQ(read_contours(path).frames[0].speaker, "S1");
  EXPECT_NE(error(path, as("tongue", "rof")).find("it has 'Roof', 'dlc_TONGUE', 'Hyoid'"),
            std::string::npos);
}

TEST_F(Formats, AaaAsksWhereNoSplineOrSeveralAreTheTongues) {
  const Spline roof("Roof", 21, 3, 80), a("Tongue", 20, 3, 60), b("DLC_Tongue", 11, 6, 60);
  EXPECT_NE(error(write("r.tsv", before + roof.titles + "\n" + begin + roof.values + "\n"))
                .find("no spline is named for the tongue; it has 'Roof'"),
            std::string::npos);
  EXPECT_NE(error(write("t.tsv",
                        before + a.titles + b.titles + "\n" + begin + a.values + b.values + "\n"))
                .find("several splines are named for the tongue"),
            std::string::npos);
  const auto alone = write("p.tsv", before + a.titles + "\n" + begin + a.values + "\n");
  EXPECT_EQ(read_contours(alone, as("palate")).frames[0].points.size(), 20u);
}

TEST_F(Formats, AaaRowsWithMoreFieldsThanTheHeaderAreNamed) {
  const Spline t("Tongue", 20, 3, 60);
  EXPECT_NE(error(write("t.tsv", before + t.titles + "\nS1\t0.5\tsay\tata" + t.values + "\n"))
                .find(":2: 44 fields; the first line has 43"),
            std::string::npos);
  const auto f =
      read_contours(write("e.tsv", before + t.titles + "\n" + begin + t.values + "\t\n"));
  EXPECT_EQ(f.frames[0].points.size(), 20u);
  EXPECT_NE(error(write("x.tsv", before + t.titles + "\nS1\tsay\tata" + t.values + "\n"))
                .find("time of the sample"),
            std::string::npos);
}

TEST_F(Formats, KnotsOfAWideSplineAreAllUsed) {
  const Spline t("DLC_Tongue", 8, 13, 60);
  const auto f = read_contours(write("w.tsv", before + t.titles + "\n" + begin + t.values + "\n"));
  EXPECT_EQ(f.frames[0].points.size(), 8u);
  EXPECT_TRUE(f.frames[0].note.empty());
}

TEST_F(Formats, KnotsBeyondAGapAreLeftOutInWords) {
  Spline t("Tongue", 20, 3, 60);
  const auto text =
      before + t.titles + "\tX20 Tongue\tY20 Tongue\n" + begin + t.values + "\t-60\t10\n";
  const auto f = read_contours(write("g.tsv", text));
  EXPECT_EQ(f.frames[0].points.size(), 20u);
  EXPECT_EQ(f.frames[0].note, "1 knots beyond a gap left out");
  EXPECT_TRUE(says(f, "1 of 21 knots left out in 1 frames"));
  EXPECT_EQ(read_contours(write("g.tsv", text), as("palate", "Tongue")).frames[0].points.size(),
            21u);
}

TEST_F(Formats, AKnotThatStraysCostsNoneOfItsNeighbours) {
  const Spline t("Tongue", 20, 3, 60);
  std::string values = t.values;
  const size_t at = values.find('\t', values.find('\t', values.find('\t') + 1) + 1);
  values = values.substr(0, at) + "\t-900" + values.substr(values.find('\t', at + 1));
  const auto f = read_contours(write("s.tsv", before + t.titles + "\n" + begin + values + "\n"));
  EXPECT_EQ(f.frames[0].points.size(), 19u);
  EXPECT_EQ(f.frames[0].note, "1 knots beyond a gap left out");
}

TEST_F(Formats, AaaBlocksOfXAndYInTurn) {
  std::string pairs, confidences;
  for (size_t k = 0; k < line.size(); ++k) {
    pairs += fmt::format("\t{:.4f}\t{:.4f}", -line[k][0], line[k][1]);
    confidences += k < 3 ? "\t20" : "\t95";
  }
  const std::string header =
      "Client Surname\tPrompt\tTime of sample in recording\tX,Y values of spline \"Tongue\"\t"
      "Confidence values of spline \"Tongue\"\n";
  const auto f = read_contours(write("b.txt", header + "S\tata\t0.5" + pairs + confidences + "\n"));
  ASSERT_EQ(f.frames.size(), 1u);
  EXPECT_EQ(f.frames[0].points.size(), line.size() - 3);
  EXPECT_NEAR(1e3 * f.frames[0].points[0].position[0], line[3][0], 1e-3);
  EXPECT_TRUE(says(f, "3 of 30 knots left out: their confidence is below 50"));
  EXPECT_NE(error(write("b.txt", header + "S\tsay\tata\t0.5" + pairs + confidences + "\n"))
                .find(":2: 94 fields"),
            std::string::npos);
}

TEST_F(Formats, ATableOfNumbersAloneIsNotAaas) {
  std::string row;
  for (int k = 0; k < 98; ++k) row += fmt::format("{}{}.5", k == 0 ? "" : "\t", k);
  const std::string said = error(write("e.txt", row + "\n"));
  EXPECT_EQ(said.find("knot"), std::string::npos);
  EXPECT_NE(said, "");
}

TEST_F(Formats, AaaMayHavePassedThroughASpreadsheet) {
  const Spline tongue("Tongue", 20, 3, 60);
  const std::string tabs = before + tongue.titles + "\n" + begin + tongue.values + "\n";
  std::string commas = tabs, semicolons = tabs;
  std::replace(commas.begin(), commas.end(), '\t', ',');
  std::replace(semicolons.begin(), semicolons.end(), '.', ',');
  std::replace(semicolons.begin(), semicolons.end(), '\t', ';');
  const Vec3 first = read_contours(write("a.tsv", tabs)).frames[0].points[3].position;
  for (const auto& [name, text] : {std::pair{"a.csv", commas}, std::pair{"b.csv", semicolons}}) {
    const ContourFile f = read_contours(write(name, text));
    EXPECT_EQ(f.format.name, "aaa");
    ASSERT_EQ(f.frames[0].points.size(), 20u);
    EXPECT_LT((f.frames[0].points[3].position - first).head<1>().norm(), 1e-12);
  }
}

TEST_F(Formats, ContoursOfMillimetresAndStrayPointsAreNamed) {
  std::string small = "x,y,frame\n", stray = small;
  for (size_t k = 0; k < line.size(); ++k) {
    small += fmt::format("{:.3f},{:.3f},1\n", 0.1 * line[k][0], 0.1 * line[k][1]);
    stray += fmt::format("{:.3f},{:.3f},1\n", (k == 7 ? 100 : 1) * line[k][0], line[k][1]);
  }
  ReadOptions mm;
  mm.units = "mm", mm.facing = "left";
  const auto said = [&](const std::string& text) -> std::string {
    try {
      read_contours(write("t.csv", text), mm);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(said(small).find("Is each row a frame"), std::string::npos) << said(small);
  EXPECT_NE(said(stray).find("frame 1, point 8"), std::string::npos) << said(stray);
}

}  // namespace
}  // namespace genio
