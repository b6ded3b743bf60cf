#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "forward/model/build_model.hpp"
#include "inverse/recording/frame_target.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

class ContourFiles : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    path =
        (std::filesystem::temp_directory_path() / ("genio_contour_" + std::to_string(::getpid())))
            .string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string error(const std::string& text) {
    try {
      read_contours(write(text));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  void TearDown() override { std::filesystem::remove(path); }
  std::string path;
};

/// One AAA row: 11 columns before the knots, then `knots` pairs; missing knots are '*'.
std::string aaa_row(int knots, const std::string& end, int valid_from = 10, int valid_to = 30) {
  std::string row = "sp\t1.25\t29/11/2016 15:10:47\tDico\ta\t0\t0\t0\t0\t0\t0";
  for (int k = 0; k < knots; ++k)
    row += k >= valid_from && k < valid_to
               ? "\t" + std::to_string(30 - 2 * k) + ".5\t" + std::to_string(k)
               : "\t*\t*";
  return row + end;
}

TEST_F(ContourFiles, CsvWithAllColumns) {
  const auto f = read_contours(
      write("frame,point,x_mm,y_mm,z_mm,sigma_mm,kind,label,time_s\r\n"
            "3,1,80,,110,0.4,curve,i,0.5\r\n3,2,60,0,100,,tip,,\r\n4,1,90,5,112,1,surface,,\r\n"));
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[0].number, 3);
  EXPECT_EQ(f.frames[0].label, "i");
  EXPECT_DOUBLE_EQ(f.frames[0].time_s, 0.5);
  EXPECT_TRUE(std::isnan(f.frames[0].points[0].position[1]));
  EXPECT_DOUBLE_EQ(f.frames[0].points[0].sigma, 4e-4);
  EXPECT_EQ(f.frames[0].points[1].kind, "tip");
  EXPECT_TRUE(f.model_frame);
}

TEST_F(ContourFiles, CsvErrorsNameLineAndField) {
  EXPECT_NE(error("frame,point,x_mm,z_mm\n1,1,80,110\n1,2,nan,3\n").find(":3: field x_mm"),
            std::string::npos);
  EXPECT_NE(error("frame,point,x_mm\n1,1,80\n").find("'z_mm' is missing"), std::string::npos);
  EXPECT_NE(error("frame,point,x_mm,z_cm\n1,1,80,1\n").find("did you mean z_mm"),
            std::string::npos);
  EXPECT_NE(error("frame,point,x_mm,z_mm\n1,1,80\n").find(":2: 3 fields; the header has 4"),
            std::string::npos);
  EXPECT_NE(error("frame,point,x_mm,z_mm\n").find("no row"), std::string::npos);
  EXPECT_NE(error(""), "");
}

TEST_F(ContourFiles, AaaWithoutHeaderKeepsEmptyRowsAndCrLf) {
  const auto f = read_contours(write(aaa_row(42, "\r\n") + aaa_row(42, "\r\n", 0, 0)));
  EXPECT_EQ(f.format.name, "aaa");
  EXPECT_FALSE(f.model_frame);
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[0].points.size(), 20u);
  EXPECT_EQ(f.frames[0].label, "Dico");
  EXPECT_NEAR(f.frames[0].points[0].position[0], -10.5e-3, 1e-12);  // turned to face left
  EXPECT_TRUE(f.frames[1].points.empty());
  EXPECT_FALSE(f.frames[1].note.empty());
}

TEST_F(ContourFiles, AaaHeaderNamesTheKnots) {
  std::string header = "Prompt\tTime of sample in recording";
  std::string row = "paka\t0.75";
  for (int k = 0; k < 11; ++k) {
    header += "\tX" + std::to_string(k) + " DLC_Tongue\tY" + std::to_string(k) + " DLC_Tongue";
    row += "\t" + std::to_string(3 * k) + "\t" + std::to_string(k);
  }
  header += "\tX0 Palate\tY0 Palate";
  row += "\t1\t1";
  const auto f = read_contours(write(header + "\n" + row + "\n"));
  ASSERT_EQ(f.frames.size(), 1u);
  EXPECT_EQ(f.frames[0].label, "paka");
  EXPECT_DOUBLE_EQ(f.frames[0].time_s, 0.75);
  EXPECT_EQ(f.frames[0].points.size(), 11u);
}

TEST_F(ContourFiles, AaaErrorsNameLineAndKnot) {
  std::string row = aaa_row(42, "\n");
  EXPECT_NE(error(aaa_row(40, "\n")).find(":1: 91 columns"), std::string::npos);
  row.replace(row.find("10.5"), 4, "oops");
  EXPECT_NE(error(aaa_row(42, "\n") + row).find(":2: knot 10"), std::string::npos);
}

TEST_F(ContourFiles, WrongUnitsAreSuspected) {
  const Model m = read_model(test::generic_model());
  const auto metres =
      read_contours(write("frame,point,x_mm,z_mm\n1,1,0.08,0.11\n1,2,0.09,0.112\n1,3,0.1,0.11\n"));
  EXPECT_THROW(make_target(m, metres.frames[0], 5e-4), InputError);
  const auto huge = read_contours(write("frame,point,x_mm,z_mm\n1,1,80000,110000\n"));
  EXPECT_THROW(make_target(m, huge.frames[0], 5e-4), InputError);
}

TEST_F(ContourFiles, UnknownFleshPointSuggestsTheNearest) {
  const Model m = read_model(test::generic_model());
  const auto f = read_contours(write("frame,point,x_mm,z_mm,kind\n1,1,60,100,tipp\n"));
  try {
    make_target(m, f.frames[0], 5e-4);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean tip"), std::string::npos);
  }
}

}  // namespace
}  // namespace genio
