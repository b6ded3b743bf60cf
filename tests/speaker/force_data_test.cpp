// Measured curves: what is read, and the one line that says what is wrong.

#include "speaker/indentation/force_data.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "speaker/indentation/curve_between.hpp"

namespace genio {
namespace {

const std::string good =
    "depth_mm,force_N,sd\n1,0.01,0.001\n2,0.03,0.001\n3,0.06,0.002\n"
    "4,0.1,0.003\n5,0.15,0.004\n";

ForceFile read_text(const std::string& text) {
  const std::string path = testing::TempDir() + "force_data_test.csv";
  std::ofstream(path) << text;
  return read_force_file(path);
}

std::string complaint_about(const std::string& text) {
  try {
    read_text(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no complaint";
}

TEST(ForceData, AreReadInAnyOrderOfColumnsWithTheirRemarks) {
  const ForceFile f = read_text(
      "# measured in the morning\n# indenter = sphere\n# radius_mm = 7\n"
      "note,force_N,depth_mm\nx,0.15,5\nx,0.1,4\nx,0.06,3\nx,0.03,2\nx,0.01,1\n");
  ASSERT_EQ(f.data.depth.size(), 5);
  EXPECT_FALSE(f.data.sd);
  EXPECT_DOUBLE_EQ(f.data.depth[0], 1e-3);  // from the first touch inwards
  EXPECT_DOUBLE_EQ(f.data.force[4], 0.15);
  const IndentationExperiment e = experiment_of(f.notes, false);
  EXPECT_EQ(e.indenter, Indenter::sphere);
  EXPECT_DOUBLE_EQ(e.radius, 7e-3);
  EXPECT_DOUBLE_EQ(e.half_width, 70e-3);
  ASSERT_TRUE(read_text(good).data.sd);
}

TEST(ForceData, WhatAPersonSaysGoesBeforeTheFile) {
  ExperimentNotes said, file;
  said.radius_mm = 3, file.radius_mm = 4, file.thickness_mm = 9;
  const IndentationExperiment e = experiment_of(merged(said, file), true);
  EXPECT_DOUBLE_EQ(e.radius, 3e-3);
  EXPECT_DOUBLE_EQ(e.thickness, 9e-3);
  EXPECT_DOUBLE_EQ(e.mucosa, 1e-3);
}

struct Broken {
  std::string text, complaint;
};

TEST(ForceData, ThatAreWrongAreRefusedWithLineFieldAndWhatWasExpected) {
  const std::string header = "depth_mm,force_N,sd\n";
  for (const auto& [text, complaint] : std::vector<Broken>{
           {"", "empty"},
           {"depth_mm,force\n1,2\n", ":1: no column force_N"},
           {"depth_m,force_N\n1,2\n", ":1: no column depth_mm"},
           {header, "no row below the header"},
           {header + "1,0.01\n", ":2: 2 fields"},
           {header + "-1,0.01,0.1\n", ":2: depth_mm: -1; expected 0 or more"},
           {header + "1,nan,0.1\n", ":2: force_N: 'nan'; expected a number"},
           {header + "1,0.1,0\n", ":2: sd: 0; expected"},
           {header + "1,0.1,-0.1\n", ":2: sd: -0.1; expected"},
           {header + "5000,0.1,0.1\n", "are these other units?"},
           {header + "1,1e5,0.1\n", "are these other units?"},
           {header + "1,0.01,0.1\n2,0.02,0.1\n", "2 different depths above 0; expected at least 5"},
           {header + "1,.1,.1\n2,.1,.1\n3,.1,.1\n2.5,.1,.1\n4,.1,.1\n5,.1,.1\n",
            ":5: depth_mm 2.5 comes after 3"},
           {good + "5,0.9,0.004\n", ":7: force_N 0.9 at depth_mm 5, where line 6 has 0.15"},
           {"depth_mm,force_N\n.001,.1\n.002,.2\n.003,.3\n.004,.4\n.005,.5\n", "are these metres?"},
           {"depth_mm,force_N\n1,-.1\n2,-.2\n3,-.3\n4,-.4\n5,-.5\n", "do not grow with depth"},
           {"# radius_m = 5\n" + good, ":1: unknown remark 'radius_m'"},
           {"# radius_mm = -5\n" + good, ":1: radius_mm = '-5'; expected a number above 0"},
           {"# indenter = cone\n" + good, "expected punch, sphere or pressure"}})
    EXPECT_NE(complaint_about(text).find(complaint), std::string::npos)
        << complaint << " | " << complaint_about(text);
}

TEST(ForceData, MayHaveDecimalCommasBetweenSemicolons) {
  const ForceFile f = read_text("force_N;depth_mm\n0,01;1\n0,03;2\n0,06;3\n0,1;4\n0,15;5,5\n");
  EXPECT_DOUBLE_EQ(f.data.depth[4], 5.5e-3);
  EXPECT_DOUBLE_EQ(f.data.force[0], 0.01);
}

TEST(ForceData, OfOneDepthMayScatter) {
  EXPECT_EQ(read_text(good + "5,0.153,0.004\n").data.depth.size(), 6);
}

// What a sphere on a layer does, about.
TEST(CurveBetween, FollowsASmoothCurveToAThousandth) {
  const Vector depths = Vector::LinSpaced(200, 0.05e-3, 5e-3);
  const CurveBetween between(depths, Indenter::sphere);
  EXPECT_LE(between.nodes.size(), 10u);
  const auto force = [](double d) { return std::pow(d, 1.5) * std::exp(250 * d); };
  Vector nodes(Eigen::Index(between.nodes.size()));
  for (size_t k = 0; k < between.nodes.size(); ++k)
    nodes[Eigen::Index(k)] = force(between.nodes[k]);
  const Vector found = between.weights * nodes;
  for (Eigen::Index i = 0; i < depths.size(); ++i)
    if (depths[i] > 0.2e-3) {
      EXPECT_NEAR(found[i] / force(depths[i]), 1, 1e-3);
    }
}

}  // namespace
}  // namespace genio
