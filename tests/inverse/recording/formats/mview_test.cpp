// MVIEW's MATLAB files give their sensors, times and labels in both versions, and broken ones a
// reason.

#include "tests/inverse/recording/formats/mat_fixture.hpp"

namespace genio {
namespace {

/// Three samples each: x y z and three angles.
std::vector<float> signal_of(float x) {
  return {x, x + 1, x + 2, 1, 1, 1, -5, -6, -7, 9, 9, 9, 8, 8, 8, 7, 7, 7};
}

ReadOptions tongue() {
  ReadOptions o;
  o.sensors = {{"TT", "tip+10mm"}, {"TB", "tip+30mm"}};
  return o;
}

ReadOptions tongue_tip() {
  ReadOptions o;
  o.sensors = {{"TT", "tip"}};
  return o;
}

class Mview : public MatFiles {
 protected:
  std::string take(const std::string& name, mat_ft version) {
    return mview(name, version, {{"TB", 100, 6, signal_of(-35)}, {"TT", 100, 6, signal_of(-16)}},
                 {{"sp", 0, 0.01}, {"AH0", 0.01, 0.02}});
  }
};

TEST_F(Mview, BothVersionsGiveSensorsTimesAndLabels) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    SCOPED_TRACE(version == MAT_FT_MAT5 ? "v5" : "v7.3");
    const auto raw = read_raw(take("take.mat", version), tongue());
    EXPECT_EQ(raw.file.format.name, "mview");
    ASSERT_EQ(raw.file.frames.size(), 3u);
    const auto& frame = raw.file.frames[1];
    EXPECT_DOUBLE_EQ(frame.time_s, 0.01);
    EXPECT_EQ(frame.label, "AH0");
    EXPECT_EQ(raw.file.frames[0].label, "sp");
    EXPECT_EQ(raw.file.frames[2].label, "");
    EXPECT_EQ(frame.recording, "take");
    ASSERT_EQ(frame.points.size(), 2u);
    EXPECT_EQ(frame.points[0].kind, "tip+30mm");
    EXPECT_TRUE(frame.points[0].position.isApprox(Vec3(-34, 1, -6)));
    EXPECT_TRUE(says(raw.file, "labels are those of PHONES"));
  }
}

TEST_F(Mview, SensorsAreNamedWhereNoneIsAskedFor) {
  const std::string said = error(take("take.mat", MAT_FT_MAT5));
  EXPECT_NE(said.find("TB: about (-34.0, 1.0, -6.0)"), std::string::npos) << said;
  EXPECT_EQ(said.find("AUDIO"), std::string::npos);
}

TEST_F(Mview, TwoCoordinatesAreHorizontalAndVertical) {
  const auto raw =
      read_raw(mview("flat.mat", MAT_FT_MAT5, {{"TT", 200, 2, {-16, -17, -5, -6}}}), tongue_tip());
  EXPECT_TRUE(raw.file.frames[1].points[0].position.isApprox(Vec3(-17, 0, -6)));
}

TEST_F(Mview, TrajectoriesOfAnotherRateAreLeftOutAndNamed) {
  const auto raw = read_raw(mview("rates.mat", MAT_FT_MAT5,
                                  {{"TT", 100, 6, signal_of(-16)},
                                   {"TB", 100, 6, signal_of(-35)},
                                   {"LAR", 500, 2, {1, 2, 3, 4}}}),
                            tongue());
  EXPECT_TRUE(says(raw.file, "LAR left out: it has 500 samples a second, the others 100"));
}

TEST_F(Mview, AMatrixIsAPalateByItsNameOrAsTheOnlyOne) {
  const std::vector<float> flat = {0, -10, -20, -30, -40, 2, 8, 10, 9, 5},
                           solid = {0, -10, -20, -30, -40, 1, 1, 1, 1, 1, 2, 8, 10, 9, 5};
  ReadOptions o;
  o.role = "palate";
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const auto one = read_raw(saved("p.mat", version, {matrix("trace", 5, 2, flat)}), o);
    const auto pal = read_raw(
        saved("q.mat", version, {matrix("pha", 5, 2, flat), matrix("pal", 5, 3, solid)}), o);
    ASSERT_EQ(pal.file.frames.front().points.size(), 5u);
    EXPECT_TRUE(one.file.frames[0].points[1].position.isApprox(Vec3(-10, 0, 8)));
    EXPECT_TRUE(pal.file.frames[0].points[1].position.isApprox(Vec3(-10, 1, 8)));
  }
  const auto path =
      saved("two.mat", MAT_FT_MAT5, {matrix("a", 5, 2, flat), matrix("b", 5, 2, flat)});
  EXPECT_NE(error(path, o).find("'a', 'b'; say which"), std::string::npos) << error(path, o);
  o.spline = "b";
  EXPECT_EQ(read_raw(path, o).file.frames.size(), 1u);
}

TEST_F(Mview, SensorsOnAPlateAreKnownByTheirNamesOrAskedFor) {
  ReadOptions o;
  o.role = "bite plane";
  const auto plate = mview("bp.mat", MAT_FT_MAT5,
                           {{"OS", 100, 6, signal_of(0)},
                            {"MS", 100, 6, signal_of(-30)},
                            {"TT", 100, 6, signal_of(-9)}});
  const auto raw = read_raw(plate, o);
  ASSERT_EQ(raw.file.frames.front().points.size(), 2u);
  const auto other = mview("tt.mat", MAT_FT_MAT5, {{"TT", 100, 6, signal_of(-9)}});
  EXPECT_NE(error(other, o).find("--bite-plane-sensors OS,MS; it has TT"), std::string::npos)
      << error(other, o);
  o.sensors = {{"TT", "bite plane"}};
  EXPECT_EQ(read_raw(other, o).file.frames.front().points.size(), 1u);
}

TEST_F(Mview, OtherMatlabFilesAreNamedAsWhatTheyAre) {
  const auto path = saved("m.mat", MAT_FT_MAT5, {matrix("masks", 2, 2, {1, 2, 3, 4})});
  EXPECT_NE(error(path, tongue()).find("none of its variables ('masks')"), std::string::npos);
  EXPECT_NE(error(mview("d.mat", MAT_FT_MAT5, {{"TT", 0, 6, signal_of(1)}}), tongue())
                .find("'TT' has no SRATE above 0"),
            std::string::npos);
  EXPECT_NE(error(write("t.mat", "no such thing"), tongue()).find("is no MATLAB file"),
            std::string::npos);
}

TEST_F(Mview, BrokenFilesGiveSamplesOrAReason) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const std::string whole = bytes_of(take("take.mat", version));
    int refused = 0;
    for (size_t k = 0; k < 60; ++k) {
      std::string bytes = whole;
      if (k % 2 == 0) bytes.resize(whole.size() * k / 60);
      else bytes[whole.size() * k / 60] = char(bytes[whole.size() * k / 60] ^ 0xFF);
      refused += !error(write("broken.mat", bytes), tongue()).empty();
    }
    EXPECT_GE(refused, 30);
  }
}

}  // namespace
}  // namespace genio
