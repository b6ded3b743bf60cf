// Every spline format gives back the contour that was written in it, and says what it took for
// granted.

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

TEST_F(Formats, GetContoursLongInPixelsLookingRight) {
  std::string text = "FRAME\tTIME\tNOTE\tPOINT\tX\tY\n";
  for (int k = 0; k < 2; ++k)
    for (size_t i = 0; i < line.size(); ++i)
      text += fmt::format("{}\t{}\tword\t{}\t{:.4f}\t{:.4f}\n", 12 + k, 0.01 * k, i + 1,
                          (0 - line[i][0]) / 0.2, (0 - line[i][1] - k) / 0.2);
  const auto path = write("a.tsv", text);
  ReadOptions o;
  EXPECT_NE(error(path).find("--mm-per-px"), std::string::npos);
  o.mm_per_px = 0.2;
  EXPECT_FALSE(read_contours(path, o).facing_known);
  o.facing = "right";
  const auto f = read_contours(path, o);
  expect_line(f);
  EXPECT_EQ(f.frames[0].number, 12);
  EXPECT_EQ(f.frames[0].label, "word");
  EXPECT_DOUBLE_EQ(f.frames[1].time_s, 0.01);
  EXPECT_FALSE(f.model_frame);
}

TEST_F(Formats, GetContoursWideInMillimetres) {
  std::string text = "FRAME\tTIME\tNOTE";
  for (size_t i = 1; i <= line.size(); ++i) text += fmt::format("\tmmX{:03d}\tmmY{:03d}", i, i);
  for (int k = 0; k < 2; ++k) {
    text += fmt::format("\n{}\t0\t", k + 1);
    for (const Vec2& q : line) text += fmt::format("\t{:.4f}\t{:.4f}", q[0], q[1] + k);
  }
  ReadOptions o;
  o.facing = "left";
  const auto f = read_contours(write("w.tsv", text + "\n"), o);
  expect_line(f);
  EXPECT_TRUE(says(f, "units mm"));
  EXPECT_TRUE(says(f, "y grows up (by the arch)"));
}

TEST_F(Formats, EdgeTrakConWithBlanksAndAnEmptyLastField) {
  std::string text;
  for (const Vec2& q : line)  // y down
    text +=
        fmt::format("\t{:.3f}\t{:.3f}\t{:.3f}\t{:.3f}\t\n", q[0], 300 - q[1], q[0], 300 - q[1] - 1);
  ReadOptions o;
  o.facing = "left";
  auto f = read_contours(write("a.con", text), o);
  EXPECT_TRUE(says(f, "y grows down (by the arch)"));
  for (auto& frame : f.frames)
    for (auto& p : frame.points) p.position[2] += 0.3;
  expect_line(f);
}

TEST_F(Formats, GetContoursTableForEdgeTrak) {
  std::string text = "FRAME7\t\tFRAME9\t\nX\tY\tX\tY\n";
  for (const Vec2& q : line)
    text += fmt::format("{:.3f}\t{:.3f}\t{:.3f}\t{:.3f}\n", q[0], q[1], q[0], q[1] + 1);
  ReadOptions o;
  o.facing = "left";
  const auto f = read_contours(write("b_EdgeTrak.tsv", text), o);
  expect_line(f);
  EXPECT_EQ(f.frames[1].number, 9);
}

TEST_F(Formats, PlainWideCsv) {
  std::string text;
  for (const Vec2& q : line)
    text += fmt::format("{:.4f},{:.4f},{:.4f},{:.4f}\n", 0.1 * q[0], 0.1 * q[1], 0.1 * q[0],
                        0.1 * (q[1] + 1));
  ReadOptions o;
  o.facing = "left";
  const auto f = read_contours(write("p.csv", text), o);
  expect_line(f);
  EXPECT_TRUE(says(f, "units cm (by their extent)"));
  EXPECT_TRUE(says(f, "from tip to root"));
}

TEST_F(Formats, AaaPolarBlocks) {
  std::string text =
      "Prompt\tTime of sample in recording\tNumber of points of spline \"Tongue\"\t"
      "R mm values\tAngle values\n";
  for (int k = 0; k < 2; ++k) {
    std::string radii, angles;
    for (const Vec2& q : line) {
      const double x = -q[0], y = q[1] + k;  // to the front
      radii += fmt::format("\t{:.6f}", std::hypot(x, y));
      angles += fmt::format("\t{:.8f}", std::atan2(x, y));
    }
    text += fmt::format("word\t{}\t{}{}{}\n", 0.5 + k, line.size(), radii, angles);
  }
  const auto f = read_contours(write("polar.tsv", text));
  expect_line(f);
  EXPECT_EQ(f.frames[0].label, "word");
  EXPECT_DOUBLE_EQ(f.frames[1].time_s, 1.5);
  EXPECT_TRUE(f.facing_known);
}

}  // namespace
}  // namespace genio
