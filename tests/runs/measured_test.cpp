// A recording that cannot be laid beside the model gives no frames, unless its owner insists.

#include "runs/frames/measured.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "forward/model/build_model.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/target/tongue_line.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

class MeasuredTest : public testing::Test {
 protected:
  /// The tongue at rest as a table in the model's frame, its numbers changed.
  std::string table(double along, double across) {
    const std::string path = folder.path() + "/rest.csv";
    std::ofstream out(path);
    out << "frame,point,x_mm,z_mm\n";
    int k = 0;
    for (const Vec2& q : TongueLine(model).sample(model.rest, 30))
      out << fmt::format("1,{},{:.4f},{:.4f}\n", ++k, 1e3 * along * q[0], 1e3 * across * q[1]);
    return path;
  }
  Measured read(const std::string& path, bool force = false) {
    MeasuredOptions o;
    o.target = path, o.force = force;
    return read_measured(
        o, [&]() -> const Model& { return model; }, [&](const std::string& r) { remarks += r; });
  }
  const Model model = read_model(test::generic_model());
  const test::TemporaryFolder folder;
  std::string remarks;
};

TEST_F(MeasuredTest, WhatLiesWhereTheTongueIsPassesAndSaysSo) {
  const Measured m = read(table(1, 1));
  EXPECT_EQ(m.frames.size(), 1u);
  const auto json = registration_json(m.registration);
  EXPECT_FALSE(json["doubtful"]);
  EXPECT_EQ(json["by"], "given");
  EXPECT_LT(json["from_rest_mm"], 1);
}

TEST_F(MeasuredTest, MirrorImagesAndOtherUnitsGiveNoFrames) {
  EXPECT_THROW(read(table(-1, 1)), RegistrationFailed);
  EXPECT_THROW(read(table(0.1, 0.1)), RegistrationFailed);
  EXPECT_THROW(read(table(0.6, 0.6)), RegistrationFailed);
}

TEST_F(MeasuredTest, WhoInsistsIsToldInEveryResult) {
  const Measured m = read(table(-1, 1), true);
  EXPECT_EQ(m.frames.size(), 1u);
  const auto json = registration_json(m.registration);
  EXPECT_TRUE(json["doubtful"]);
  EXPECT_TRUE(json["forced"]);
  EXPECT_NE(remarks.find("DOUBTFUL"), std::string::npos);
  // Nor can a tongue be said not to reach points whose place is doubtful.
  for (const char* verdict : {"explained", "unreachable", "mismatch"}) {
    AnswerView view;
    view.verdict = verdict;
    view = with_registration(view, m.registration);
    EXPECT_NE(view.title.find("doubtful"), std::string::npos);
    EXPECT_EQ(view.verdict, "none");
    EXPECT_NE(view.message.find("doubtful"), std::string::npos);
  }
}

/// Ultrasound of the example, with its palate.
MeasuredOptions ultrasound() {
  const std::string example = std::string(GENIO_SOURCE_DIR) + "/data/examples/recording/";
  MeasuredOptions o;
  o.target = example + "contours.tsv", o.palate = example + "palate.tsv";
  return o;
}

TEST(MeasuredChoice, AWrongOneIsSaidBeforeTheRegistration) {
  const auto complaint = [](const FrameChoice& choice) -> std::string {
    MeasuredOptions o = ultrasound();
    o.choice = choice;
    try {
      read_measured(
          o, []() -> const Model& { throw std::logic_error("registered"); }, [](const auto&) {});
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({.frames = "5-3"}).find("--frames 5-3"), 0u);
  EXPECT_EQ(complaint({.frames = "9000"}).find("--frames 9000"), 0u);
  EXPECT_EQ(complaint({.tier = "words"}).find("--tier words"), 0u);
  EXPECT_EQ(complaint({.labels = {"nobody says this"}}).find("--labels"), 0u);
  EXPECT_NE(complaint({.textgrid = "/nowhere.TextGrid"}).find("/nowhere.TextGrid"),
            std::string::npos);
}

TEST_F(MeasuredTest, WhatWasTakenForGrantedOfThePalateIsToldUnderItsName) {
  const MeasuredOptions o = ultrasound();
  std::vector<std::string> lines;
  read_measured(
      o, [&]() -> const Model& { return model; },
      [&](const std::string& line) { lines.push_back(line); });
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.find(o.palate + ": units mm") == 0;
  })) << testing::PrintToString(lines);
}

TEST_F(MeasuredTest, OneRegistrationDoesNotPlaceTwoHeads) {
  const std::string path = folder.path() + "/two.csv";
  std::ofstream out(path);
  out << "x_mm,y_mm,frame,speaker\n";
  for (const char* speaker : {"A", "B"})
    for (const Vec2& q : TongueLine(model).sample(model.rest, 30))
      out << fmt::format("{:.3f},{:.3f},1,{}\n", 1e3 * q[0] - 50, 1e3 * q[1] - 60, speaker);
  out.close();
  MeasuredOptions o;
  o.target = path, o.read.facing = "left", o.read.up = "up";
  const auto frames = [&] {
    return read_measured(
               o, [&]() -> const Model& { return model; }, [](const std::string&) {})
        .frames.size();
  };
  EXPECT_THROW(frames(), InputError);
  o.choice.speaker = "B";
  EXPECT_EQ(frames(), 1u);
  o.choice.speaker = "C";
  EXPECT_THROW(frames(), InputError);
}

TEST_F(MeasuredTest, UpsideDownInTheModelsFrameIsNamed) {
  const std::string path = folder.path() + "/down.csv";
  std::ofstream out(path);
  out << "frame,point,x_mm,z_mm\n";
  const auto line = TongueLine(model).sample(model.rest, 30);
  Vec2 middle = Vec2::Zero();
  for (const Vec2& q : line) middle += q / double(line.size());
  for (size_t k = 0; k < line.size(); ++k)
    out << fmt::format("1,{},{:.4f},{:.4f}\n", k + 1, 1e3 * line[k][0],
                       1e3 * (2 * middle[1] - line[k][1]));
  out.close();
  EXPECT_THROW(read(path), RegistrationFailed);
}

TEST(MeasuredChoice, WhatWasSeenAndHowItIsLaidMakeWhatIsMeasured) {
  const Model model = read_model(test::generic_model());
  const auto read = [&](bool as_seen) {
    MeasuredOptions o = ultrasound();
    o.as_seen = as_seen;
    return read_measured(
        o, [&]() -> const Model& { return model; }, [](const std::string&) {});
  };
  const Measured laid = read(false), seen = read(true);
  MeasuredOptions o = ultrasound();
  const Unregistered u = read_unregistered(o, [](const std::string&) {});
  ASSERT_TRUE(laid.transform && seen.transform && laid.head_pose);
  ASSERT_EQ(laid.frames.size(), 4u);
  ASSERT_EQ(u.frames.size(), 4u);
  EXPECT_EQ(u.noise, laid.noise);
  EXPECT_GT(u.palate.size(), 20u);
  for (size_t k = 0; k < laid.frames.size(); ++k) {
    const ContourFrame own = registered(model, seen.frames[k], *seen.transform);
    ASSERT_EQ(own.points.size(), laid.frames[k].points.size());
    for (size_t i = 0; i < own.points.size(); ++i) {
      // Across, nothing was measured.
      const Vec3 off = own.points[i].position - laid.frames[k].points[i].position;
      EXPECT_LT(std::hypot(off[0], off[2]), 1e-12);
    }
    // Nobody registered it, and it is turned the same way.
    EXPECT_NEAR(u.frames[k].points[0].position[0], seen.frames[k].points[0].position[0], 1e-12);
    EXPECT_NEAR(u.frames[k].points[0].position[2], seen.frames[k].points[0].position[2], 1e-12);
    EXPECT_EQ(u.frames[k].label, laid.frames[k].label);
  }
}

TEST(MeasuredChoice, WhatLiesBesideTheModelNeedsNoRegistration) {
  MeasuredOptions o;
  o.target = std::string(GENIO_SOURCE_DIR) + "/data/examples/example_shape.csv";
  EXPECT_THROW(read_unregistered(o, [](const std::string&) {}), InputError);
  o = ultrasound();
  o.read.facing = "left";
  const Unregistered mirrored = read_unregistered(o, [](const std::string&) {});
  o.read.facing.clear();
  const Unregistered own = read_unregistered(o, [](const std::string&) {});
  EXPECT_EQ(mirrored.palate[0][0], -own.palate[0][0]);
}

}  // namespace
}  // namespace genio
