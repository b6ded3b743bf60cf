// Recordings of sensors as people have them, read in place.

#include "tests/forward/small_model.hpp"
#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

struct Case {
  std::string file, format, remark;
  std::map<std::string, std::string> sensors;
  size_t points;
};

TEST_F(Formats, ReferenceCasesOfSensorsAreRead) {
  const std::string data = test::reference_folder();
  if (data.empty() || !std::filesystem::exists(data + "/cases"))
    GTEST_SKIP() << "the reference cases are not here";
  const std::string ssff = data + "/cases/ssff_one_sensor_a_file/s_0001.";
  const std::vector<Case> cases = {
      {"ag501_pos_cut_short/target.pos", "ag50x", "cut short", {{"1", "tip"}, {"2", "dorsum"}}, 2},
      {"ag501_write_table/target.txt", "ag501-text", "", {{"2", "tip"}, {"3", "dorsum"}}, 2},
      {"ema_98_columns/target.txt", "ag501-text", "", {{"1", "tip"}, {"3", "dorsum"}}, 2},
      {"ema_decimal_comma/target.txt", "ag501-text", "", {{"1", "tip"}, {"3", "dorsum"}}, 2},
      {"ema_sensor_places/target.txt", "ag501-text", "", {{"1", "tip"}, {"3", "dorsum"}}, 2},
      {"fmt_mocha_ascii/target.ema", "mocha", "1/100 mm", {{"tt", "tip"}, {"td", "dorsum"}}, 2},
      {"fmt_ndi_wave/target.tsv", "ndi-wave", "", {{"P01-CH0", "tip"}, {"P02-CH0", "dorsum"}}, 2},
      {"fmt_xrmb/target.txy", "xrmb", "", {{"T1", "tip"}, {"T4", "dorsum"}}, 2},
      {"ssff_one_sensor_a_file/s_0001.TT," + ssff + "TB," + ssff + "TD",
       "ssff",
       "",
       {{"TT", "tip"}, {"TB", "blade"}, {"TD", "dorsum"}},
       3},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.file);
    ReadOptions o;
    o.sensors = c.sensors;
    const ContourFile f = read_contours(data + "/cases/" + c.file, o);
    EXPECT_EQ(f.format.name, c.format);
    ASSERT_FALSE(f.frames.empty());
    EXPECT_EQ(f.frames[0].points.size(), c.points);
    EXPECT_TRUE(c.remark.empty() || says(f, c.remark));
  }
  const ContourFile palate = read_contours(data + "/cases/fmt_xrmb/palate.dat");
  EXPECT_EQ(palate.format.name, "xrmb-palate");
  EXPECT_GT(palate.frames.at(0).points.size(), 5u);
}

}  // namespace
}  // namespace genio
