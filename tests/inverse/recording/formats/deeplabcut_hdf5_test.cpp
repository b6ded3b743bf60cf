// DeepLabCut's HDF5 says what its CSV says.

#include "inverse/recording/binary/pickled_text.hpp"
#include "inverse/recording/contour_file.hpp"
#include "tests/inverse/recording/formats/pandas_fixture.hpp"

namespace genio {
namespace {

class DeepLabCutHdf5 : public PandasFiles {
 protected:
  DeepLabCutHdf5() {
    o.mm_per_px = 0.3;
    for (const char* part : {"tongueRoot", "tongueBody", "tongueTip", "hyoid"})
      for (const char* coordinate : {"x", "y", "likelihood"}) columns.push_back({part, coordinate});
    for (int r = 0; r < 3; ++r)
      for (int k = 0; k < 4; ++k) {
        const double nan = std::nan("");
        const bool lost = r == 2 && k == 1;
        values.insert(values.end(), {lost ? nan : 110 + 70.0 * k + r, lost ? nan : 170 - 10.0 * k,
                                     lost               ? nan
                                     : r == 1 && k == 2 ? 0.4
                                                        : 1 - 0.05 * k});
      }
  }
  std::string csv() {
    std::string text = "scorer", bodies = "bodyparts", coords = "coords";
    for (const Column& c : columns)
      text += ",DLC", bodies += "," + c.part, coords += "," + c.coordinate;
    text += "\n" + bodies + "\n" + coords + "\n";
    for (size_t r = 0; r < 3; ++r) {
      text += fmt::format("{}", r);
      for (size_t c = 0; c < columns.size(); ++c) {
        const double v = values[r * columns.size() + c];
        text += std::isnan(v) ? "," : fmt::format(",{}", v);
      }
      text += "\n";
    }
    return write("video.csv", text);
  }
  static void expect_same(const ContourFile& a, const ContourFile& b) {
    EXPECT_EQ(a.remarks, b.remarks);
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (size_t k = 0; k < a.frames.size(); ++k) {
      EXPECT_EQ(a.frames[k].number, b.frames[k].number);
      EXPECT_EQ(a.frames[k].note, b.frames[k].note);
      ASSERT_EQ(a.frames[k].points.size(), b.frames[k].points.size());
      for (size_t i = 0; i < a.frames[k].points.size(); ++i) {
        const auto &p = a.frames[k].points[i], &q = b.frames[k].points[i];
        EXPECT_EQ(p.position[0], q.position[0]);
        EXPECT_EQ(p.position[2], q.position[2]);
        EXPECT_EQ(p.widening, q.widening);
      }
    }
  }
  ReadOptions o;
  std::vector<Column> columns;
  std::vector<double> values;
};

TEST_F(DeepLabCutHdf5, BothFormatsOfPandasSayWhatTheCsvSays) {
  const auto text = read_contours(csv(), o);
  EXPECT_TRUE(says(text, "1 of 8 points left out: their likelihood is below 0.6"));
  expect_same(read_contours(fixed("fixed.h5", columns, values), o), text);
  expect_same(read_contours(records("table.h5", columns, values, pickled(columns)), o), text);
}

TEST_F(DeepLabCutHdf5, ImagesNameTheirFrames) {
  const auto f =
      read_contours(fixed("l.h5", columns, values, {"v/a1.png", "v/a2.png", "v/b.png"}), o);
  ASSERT_EQ(f.frames.size(), 3u);
  EXPECT_EQ(f.frames[2].label, "b.png");
  EXPECT_EQ(f.frames[2].number, 3);
}

TEST_F(DeepLabCutHdf5, WhatIsNoTableOfBodyPartsIsNamed) {
  EXPECT_NE(error(write("t.h5", "\x89HDF nothing"), o).find("t.h5: is no HDF5 file"),
            std::string::npos);
  const auto path = (folder / "e.h5").string();
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_NE(error(path, o).find("0 data frames of pandas"), std::string::npos);
  EXPECT_NE(error(records("p.h5", columns, values, "cos\nsystem\n(Vecho\ntR."), o)
                .find("titles of columns are no list"),
            std::string::npos);
  auto fewer = columns;
  fewer.pop_back();
  EXPECT_NE(error(records("f.h5", columns, values, pickled(fewer)), o).find("11 titles"),
            std::string::npos);
}

TEST_F(DeepLabCutHdf5, BrokenFilesGiveContoursOrAReason) {
  std::ifstream in(records("whole.h5", columns, values, pickled(columns)), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  int refused = 0;
  for (size_t k = 0; k < 60; ++k) {
    std::string bytes = whole;
    if (k % 2 == 0) bytes.resize(whole.size() * k / 60);
    else bytes[whole.size() * k / 60] = char(bytes[whole.size() * k / 60] ^ 0xFF);
    refused += !error(write("broken.h5", bytes), o).empty();
  }
  EXPECT_GE(refused, 30);
}

TEST(PickledTitles, TuplesOfTextsAreReadAndNothingElse) {
  const auto titles = pickled_titles("(lp0\n(VDLC\np1\nVtip\np2\ntp3\na(g1\ng2\ntp4\na.", "x.h5");
  ASSERT_EQ(titles.size(), 2u);
  EXPECT_EQ(titles[1], (std::vector<std::string>{"DLC", "tip"}));
  for (const char* bad :
       {"", ".", "(lp0\n", "a.", "g7\n.", "(lp0\n(Va\ntp1\n.", "I1\n.", "(.", "t."})
    EXPECT_THROW(pickled_titles(bad, "x.h5"), InputError) << bad;
}

}  // namespace
}  // namespace genio
