// Files that once failed, read in place; skipped where they are absent.

#include "tests/forward/small_model.hpp"
#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

class ReferenceCases : public Formats {
 protected:
  void SetUp() override {
    if (test::reference_folder().empty()) GTEST_SKIP() << "the reference data are not here";
  }
  static std::string file(const std::string& name) {
    return test::reference_folder() + "/cases/" + name;
  }
  static ContourFile palate(const std::string& name, ReadOptions o = {}) {
    o.role = "palate";
    return read_contours(file(name), o);
  }
  static ReadOptions pixels(double size) {
    ReadOptions o;
    o.mm_per_px = size;
    return o;
  }
};

TEST_F(ReferenceCases, WideKnotsAreUsed) {
  EXPECT_EQ(read_contours(file("aaa_dlc_wide_knots/target.tsv")).frames.at(0).points.size(), 11u);
  EXPECT_EQ(palate("aaa_dlc_wide_knots/palate.tsv").frames.at(0).points.size(), 14u);
}

TEST_F(ReferenceCases, LowConfidencesAreLeftOut) {
  const auto f = read_contours(file("aaa_polar_confidence/target.tsv"));
  EXPECT_EQ(f.frames.at(0).points.size(), 35u);
  EXPECT_TRUE(says(f, "7 of 42 knots left out"));
  EXPECT_EQ(palate("aaa_polar_confidence/palate.tsv").frames.at(0).points.size(), 21u);
}

TEST_F(ReferenceCases, TheTongueIsReadNotTheRoof) {
  const auto tongue = read_contours(file("aaa_roof_first/target.tsv")).frames.at(0).points;
  const auto roof = palate("aaa_roof_first/palate.tsv").frames.at(0).points;
  EXPECT_EQ(tongue.size(), 42u);
  EXPECT_EQ(roof.size(), 21u);
  EXPECT_GT((tongue[0].position - roof[0].position)[0], 0);
}

TEST_F(ReferenceCases, BlocksOfXAndYAreRead) {
  EXPECT_EQ(read_contours(file("aaa_xy_block_header/target.txt")).frames.at(0).points.size(), 42u);
}

TEST_F(ReferenceCases, BrokenTablesAreNamed) {
  EXPECT_NE(
      error(file("aaa_tab_in_prompt/target.tsv")).find(":2: 90 fields; the first line has 89"),
      std::string::npos);
  EXPECT_NE(error(file("csv_frame_twice/target.csv")).find(":44: frame 1 has two labels"),
            std::string::npos);
  EXPECT_NE(error(file("fmt_deeplabcut_stripped/target.csv"), pixels(0.3)).find("DeepLabCut"),
            std::string::npos);
}

TEST_F(ReferenceCases, PaddingIsMissing) {
  const auto f = read_contours(file("edgetrak_zero_padded/target.con"), pixels(0.25));
  EXPECT_EQ(f.frames.at(0).points.size(), 42u);
  EXPECT_EQ(f.frames.at(1).points.size(), 30u);
}

TEST_F(ReferenceCases, FormatsOfOtherProgramsAreRead) {
  const auto dlc = read_contours(file("fmt_deeplabcut/target.csv"), pixels(0.3));
  EXPECT_EQ(dlc.format.name, "deeplabcut");
  EXPECT_EQ(dlc.frames.at(0).points.size(), 8u);
  const auto mtracker = read_contours(file("fmt_mtracker/target.csv"), pixels(0.25));
  ASSERT_EQ(mtracker.frames.size(), 1u);
  EXPECT_EQ(mtracker.frames[0].points.size(), 42u);
  const auto pts = read_contours(file("fmt_usc_pts/101.pts"), pixels(0.25));
  EXPECT_EQ(pts.frames.at(0).points.size(), 20u);
}

}  // namespace
}  // namespace genio
