// Long tables, landmarks and tracks: one frame is one frame, and what is left out is said.

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

ReadOptions pixels(const std::map<std::string, std::string>& columns = {}) {
  ReadOptions o;
  o.mm_per_px = 0.25, o.columns = columns;
  return o;
}

TEST_F(Formats, AFrameWithTwoTimesLabelsOrPointsTwiceIsRefused) {
  const std::string header = "frame,point,x_mm,z_mm,time_s,label\n1,1,60,95,0.5,a\n";
  EXPECT_NE(error(write("t.csv", header + "1,2,90,115,0.9,a\n")).find(":3: frame 1 has two times"),
            std::string::npos);
  EXPECT_NE(error(write("l.csv", header + "1,2,90,115,0.5,b\n")).find("two labels, 'a' and 'b'"),
            std::string::npos);
  EXPECT_NE(error(write("p.csv", header + "1,1,90,115,0.5,a\n")).find("point 1 twice"),
            std::string::npos);
  EXPECT_NE(error(write("n.csv", "frame,x_mm,z_mm\n1,60,95\n2,60,95\n1,61,95\n"))
                .find(":4: frame 1 goes on after another frame"),
            std::string::npos);
  EXPECT_NE(error(write("g.tsv",
                        "FRAME\tTIME\tNOTE\tPOINT\tmmX\tmmY\n1\t0.5\ta\t1\t50\t60\n"
                        "1\t0.9\ta\t1\t50\t60\n"))
                .find("two times"),
            std::string::npos);
}

TEST_F(Formats, RecordingsAndSpeakersAreKeptApart) {
  const auto f = read_contours(write(
      "r.csv", "frame,point,x_mm,z_mm,recording,speaker\n1,1,60,95,r1,s1\n1,1,61,95,r2,s1\n"));
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[1].recording, "r2");
  EXPECT_EQ(f.frames[1].speaker, "s1");
}

TEST_F(Formats, ZeroPairsAtTheEndOfAContourAreMissing) {
  std::string text;
  for (size_t k = 0; k < line.size(); ++k)
    text += k < 20 ? fmt::format("{0:.2f},{1:.2f},{0:.2f},{1:.2f}\n", line[k][0], line[k][1])
                   : fmt::format("{:.2f},{:.2f},0.00,0.00\n", line[k][0], line[k][1]);
  const auto f = read_contours(write("z.con", text));
  EXPECT_EQ(f.frames[0].points.size(), 30u);
  EXPECT_EQ(f.frames[1].points.size(), 20u);
  EXPECT_TRUE(says(f, "10 pairs '0 0' at the ends of 1 contours"));
  text.insert(text.find('\n', 200) + 1, "0,0,0,0\n");
  EXPECT_NE(error(write("z.con", text)).find("'0 0' far from its neighbours"), std::string::npos);
}

TEST_F(Formats, ATableOfSeparatorsAloneHasNoPoint) {
  EXPECT_NE(error(write("e.con", ",,\n,\n,,\n")).find("has no point"), std::string::npos);
}

const std::string dlc_header =
    "scorer,D,D,D,D,D,D,D,D,D\nbodyparts,vallecula,vallecula,vallecula,tongueBody,tongueBody,"
    "tongueBody,tongueTip,tongueTip,tongueTip\ncoords,x,y,likelihood,x,y,likelihood,x,y,"
    "likelihood\n";

/// The tip lies where the face looks to.
TEST_F(Formats, NamesOfDeepLabCutsPartsTellTheFacing) {
  for (const bool right : {true, false}) {
    const auto path = write("f.csv", dlc_header + (right ? "0,100,170,1,150,95,1,250,120,1\n"
                                                         : "0,250,170,1,200,95,1,100,120,1\n"));
    const auto raw = read_raw(path, pixels());
    ASSERT_TRUE(raw.axes);
    EXPECT_EQ(raw.axes->facing, right ? "right" : "left");
  }
}

TEST_F(Formats, DeepLabCutTakesTheTonguesPartsThatAreSure) {
  const auto path = write("d.csv", dlc_header +
                                       "0,100,170,0.9,150,95,0.9,250,120,0.9\n"
                                       "1,100,170,0.9,150,95,0.9,250,120,0.1\n");
  const auto f = read_contours(path, pixels());
  EXPECT_EQ(f.format.name, "deeplabcut");
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[0].number, 1);
  EXPECT_EQ(f.frames[0].points.size(), 2u);
  EXPECT_EQ(f.frames[1].points.size(), 1u);
  EXPECT_TRUE(says(f, "1 of 4 points left out: their likelihood is below 0.6"));
  EXPECT_TRUE(says(f, "left out: vallecula"));
  ReadOptions named = pixels();
  named.spline = "vallecula";
  EXPECT_EQ(read_contours(path, named).frames[0].points.size(), 1u);
  named.spline = "lip";
  EXPECT_NE(error(path, named).find("it has 'vallecula', 'tongueBody', 'tongueTip'"),
            std::string::npos);
  EXPECT_NE(error(path).find("--mm-per-px"), std::string::npos);
}

TEST_F(Formats, DeepLabCutWithoutItsHeaderIsNamed) {
  std::string odd, even;
  for (int k = 0; k < 5; ++k) {
    odd += fmt::format("{},100,170,0.9,150,95,0.9\n", k);
    even += fmt::format("{},100,170,0.9,150,95,0.9,160,95,0.8\n", k);
  }
  for (const std::string& text : {odd, even})
    EXPECT_NE(error(write("s.csv", text), pixels()).find("DeepLabCut without"), std::string::npos);
}

TEST_F(Formats, LandmarksOfSeveralOrgansNeedARange) {
  std::string text = "version: 1\nn_points: 180\n{\n";
  for (int k = 0; k < 180; ++k) text += fmt::format("{} {}\n", 20 + 1.5 * k, 30 + k % 2);
  const auto path = write("101.pts", text + "}\n");
  ReadOptions o = pixels();
  EXPECT_NE(error(path, o).find("--points A-B"), std::string::npos);
  o.points = "11-60";
  const auto f = read_contours(path, o);
  EXPECT_EQ(f.frames[0].points.size(), 50u);
  EXPECT_EQ(f.frames[0].number, 101);
  o.points = "11-600";
  EXPECT_NE(error(path, o).find("expected A-B with 1 <= A < B <= 180"), std::string::npos);
  EXPECT_NE(error(write("2.pts", "version: 1\nn_points: 3\n{\n1 2\n}\n"), pixels())
                .find("1 points; n_points says 3"),
            std::string::npos);
}

TEST_F(Formats, LongTablesAreReadByTheirTitles) {
  const auto f = read_contours(
      write("m.csv", ",x,y,uniqueframe\n0,200,300,0\n1,300,250,0\n2,210,300,1\n3,310,250,1\n"),
      pixels());
  EXPECT_EQ(f.format.name, "columns");
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[1].number, 2);
  EXPECT_TRUE(says(f, "counts frames from 0"));
  EXPECT_NEAR(f.frames[0].points[0].position[2], -0.075, 1e-9);  // y down, as in images
}

TEST_F(Formats, LongTablesAreReadAsTheCallerNamesTheirColumns) {
  // R leaves the title of its names of rows out.
  const auto path = write("r.txt",
                          "\"px\" \"py\" \"no\" \"say\" \"rep\"\n\"1\" 200 300 5 \"a b\" 1\n"
                          "\"2\" 300 250 5 \"a b\" 1\n\"3\" NA NA 5 \"a b\" 1\n"
                          "\"4\" 210 300 5 \"a b\" 2\n");
  const auto f = read_contours(
      path,
      pixels({{"x", "px"}, {"y", "2"}, {"frame", "no"}, {"label", "say"}, {"recording", "rep"}}));
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[0].points.size(), 2u);
  EXPECT_EQ(f.frames[0].number, 5);
  EXPECT_EQ(f.frames[0].label, "a b");
  EXPECT_EQ(f.frames[1].recording, "2");
  EXPECT_NE(error(path, pixels({{"x", "px"}, {"y", "q"}})).find("no column 'q'"),
            std::string::npos);
  EXPECT_NE(error(path, pixels({{"x", "px"}})).find("names no y"), std::string::npos);
  EXPECT_NE(error(path, pixels({{"z", "px"}})).find("--columns z=px: expected x, y"),
            std::string::npos);
}

TEST_F(Formats, AColumnThatPartsAFrameIsAskedAbout) {
  std::string repeated = "x,y,frame,rep\n", again = "x,y,frame,knot\n";
  for (int k = 0; k < 20; ++k) {
    repeated += fmt::format("{},{},1,{}\n", 200 + k % 10, 300, k / 10);
    again += fmt::format("{},{},1,{}\n", 200 + k % 10, 300, k % 10);
  }
  const ReadOptions o = pixels({{"x", "x"}, {"y", "y"}, {"frame", "frame"}});
  EXPECT_NE(error(write("r.csv", repeated), o).find("column 'rep' changes within frame 1"),
            std::string::npos);
  EXPECT_NE(error(write("k.csv", again), o).find("'knot' counts from 0 again"), std::string::npos);
}

TEST_F(Formats, OptionsOfAnotherFormatAreRefused) {
  ReadOptions o;
  o.spline = "Tongue";
  EXPECT_NE(error(write("s.csv", "frame,x_mm,z_mm\n1,60,95\n"), o).find("--spline is for files"),
            std::string::npos);
  o = pixels({{"x", "x_mm"}, {"y", "z_mm"}});
  o.format = "csv";
  EXPECT_NE(error((folder / "s.csv").string(), o).find("--columns is for files"),
            std::string::npos);
}

}  // namespace
}  // namespace genio
