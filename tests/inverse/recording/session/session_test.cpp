// The axes of a device are found once for all its files, or both readings are named.

#include "inverse/recording/session/session.hpp"

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/session/session_faults.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

class SessionOfAModel : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    model = new Model(read_model(test::generic_model()));
    Workspace ws(*model);
    Parameters p = default_parameters(*model);
    set_command(*model, "GGP", 2.0, p);
    set_command(*model, "SL", 0.5, p);
    shape = new Positions(solve_equilibrium(*model, p, model->rest, ws).x);
  }
  static void TearDownTestSuite() { delete model, delete shape; }

  /// A point of the model as the device has it: a bowed head, another origin, its own axes.
  static Vec3 away(const Vec2& q, const AxesReading& reading, double scale = 1) {
    const Vec2 moved = Similarity{1 / scale, 0.15, Vec2(-0.02, 0.03)}(q);
    Vec3 p = Vec3::Constant(0.001);
    p[reading.back] = reading.back_grows ? moved[0] : -moved[0];
    p[reading.up] = reading.up_grows ? moved[1] : -moved[1];
    return p;
  }
  static ContourFile file_of(const std::vector<std::pair<Vec2, std::string>>& points,
                             const AxesReading& reading, Content content, double scale = 1) {
    ContourFile file;
    file.format.content = content, file.model_frame = false, file.facing_known = false;
    ContourFrame frame;
    frame.number = 1;
    for (const auto& [q, kind] : points)
      frame.points.push_back({.position = away(q, reading, scale), .kind = kind});
    file.frames.push_back(frame);
    return file;
  }
  static ContourFile contour(const AxesReading& reading, double scale = 1) {
    std::vector<std::pair<Vec2, std::string>> points;
    const auto line = TongueLine(*model).sample(*shape, 40);
    for (size_t k = 8; k < line.size(); ++k) points.emplace_back(line[k], "curve");
    return file_of(points, reading, Content::curves, scale);
  }
  static ContourFile sensors(const AxesReading& reading) {
    std::vector<std::pair<Vec2, std::string>> points;
    for (const char* name : {"tip", "blade", "dorsum"}) {
      const Vec3 rest = place_at_rest(*model, name);
      points.emplace_back(Vec2(rest[0], rest[2]), name);
    }
    return file_of(points, reading, Content::sensors);
  }
  static SessionFile palate(const AxesReading& reading, Content content, double scale = 1) {
    std::vector<std::pair<Vec2, std::string>> points;
    const auto cut = midsagittal_cut(*model->palate).front();
    for (size_t k = cut.size() / 6; k < 2 * cut.size() / 3; ++k)
      points.emplace_back(cut[k], content == Content::sensors ? "palate" : "curve");
    return {"palate", file_of(points, reading, content, scale), {}};
  }
  static double distance_from_truth(const AlignedRecording& a) {
    const auto line = midsagittal_points(a.file).front();
    const auto truth = TongueLine(*model).sample(*shape, 40);
    double worst = 0;
    for (size_t k = 0; k < line.size(); ++k)
      worst = std::max(worst, (a.registration.transform(line[k]) - truth[k + 8]).norm());
    return worst;
  }
  static Model* model;
  static Positions* shape;
};
Model* SessionOfAModel::model = nullptr;
Positions* SessionOfAModel::shape = nullptr;

TEST_F(SessionOfAModel, ContoursOfAnyFacingAndDirectionComeBack) {
  for (const bool back : {true, false})
    for (const bool up : {true, false}) {
      const AxesReading reading{0, 2, back, up};
      SCOPED_TRACE(reading.text(Content::curves));
      const auto a =
          align(*model, {"t", contour(reading), {}}, palate(reading, Content::curves), {});
      EXPECT_EQ(a.reading, reading);
      EXPECT_TRUE(a.judgement.faults.empty());
      EXPECT_LT(distance_from_truth(a), 3 * a.registration.shift_sd.norm());
    }
}

TEST_F(SessionOfAModel, SensorsOfAnyAxesComeBackTheSame) {
  for (const auto& [back, up] : {std::pair{0, 2}, {1, 2}, {0, 1}, {2, 1}, {1, 0}, {2, 0}})
    for (const bool back_grows : {true, false})
      for (const bool up_grows : {true, false}) {
        const AxesReading reading{back, up, back_grows, up_grows};
        SCOPED_TRACE(reading.text(Content::sensors));
        const auto a =
            align(*model, {"t", sensors(reading), {}}, palate(reading, Content::sensors), {});
        EXPECT_EQ(a.reading, reading);
        EXPECT_NEAR(a.registration.transform.scale, 1, 0.05);
      }
}

TEST_F(SessionOfAModel, APalateOfAnotherSpeakerIsRefused) {
  SessionFile target{"t", contour({}), {}}, trace = palate({}, Content::curves);
  const auto named = [&](const std::string& whose, const std::string& of) {
    for (ContourFrame& f : target.file.frames) f.speaker = whose;
    for (ContourFrame& f : trace.file.frames) f.speaker = of;
  };
  for (const auto& [whose, of] : {std::pair{"S1", "S9"}, {"S10", "S1"}, {"S1, Ann", "S10"}}) {
    named(whose, of);
    EXPECT_THROW(check_same_speaker(target, trace), InputError) << whose << " and " << of;
  }
  for (const auto& [whose, of] :
       {std::pair{"S1", "S1"}, {"S1, Ann", "S1"}, {"", "S1"}, {"S1", ""}}) {
    named(whose, of);
    EXPECT_NO_THROW(check_same_speaker(target, trace)) << whose << " and " << of;
  }
}

TEST_F(SessionOfAModel, AMirrorImageIsAFaultWhateverTheFormatSays) {
  const AxesReading left{};
  const auto a =
      align(*model, {"t", contour(left), {"mm", "right", "up"}}, palate(left, Content::curves), {});
  ASSERT_FALSE(a.judgement.faults.empty());
  EXPECT_NE(a.judgement.faults.back().find("mirror"), std::string::npos);
}

TEST_F(SessionOfAModel, WhatIsUpsideDownIsAFault) {
  ReadOptions o;
  o.up = "down";
  const auto a = align(*model, {"t", contour({}), {}}, palate({}, Content::curves), o);
  EXPECT_FALSE(a.judgement.faults.empty());
}

TEST_F(SessionOfAModel, ATongueOfNobodysSizeIsAFaultAndOthersAreNot) {
  for (const double scale : {0.5, 0.6, 1.6, 2.0}) {
    const auto a = align(*model, {"t", contour({}, scale), {"mm", "left", "up"}},
                         palate({}, Content::curves, scale), {});
    ASSERT_FALSE(a.judgement.faults.empty()) << scale;
    EXPECT_NE(a.judgement.faults.front().find("scale"), std::string::npos);
    EXPECT_NEAR(a.registration.free_scale, scale, 0.05 * scale);
  }
  for (const double scale : {0.8, 0.9, 1.0, 1.1, 1.15})
    EXPECT_TRUE(align(*model, {"t", contour({}, scale), {"mm", "left", "up"}},
                      palate({}, Content::curves, scale), {})
                    .judgement.faults.empty())
        << scale;
}

TEST_F(SessionOfAModel, ContoursBehindThePalateAreAFault) {
  ContourFile high = contour({});
  for (auto& p : high.frames[0].points) p.position[2] += 0.03;
  const auto a = align(*model, {"t", high, {"mm", "left", "up"}}, palate({}, Content::curves), {});
  EXPECT_FALSE(a.judgement.faults.empty());
}

TEST_F(SessionOfAModel, WithoutAPalateTheContoursAlignThemselvesAndSayHowWell) {
  const auto a = align(*model, {"t", contour({}), {"mm", "left", "up"}}, {}, {});
  EXPECT_TRUE(a.judgement.faults.empty());
  EXPECT_GT(a.registration.shift_sd.minCoeff(), 1e-3);
  EXPECT_GT(a.registration.tilt_sd, 0.03);
}

TEST_F(SessionOfAModel, TwoReadingsThatFitAlikeAreBothNamed) {
  // An arch about its own middle is its own mirror image.
  std::vector<std::pair<Vec2, std::string>> arch;
  for (int k = -10; k <= 10; ++k)
    arch.emplace_back(Vec2(0.09 + 3e-3 * k, 0.11 - 1.5e-4 * k * k), "curve");
  const AxesReading straight{};
  ContourFile file = file_of(arch, straight, Content::curves);
  for (auto& p : file.frames[0].points) p.position[0] -= 0.07;
  try {
    align(*model, {"arch.con", file, {"mm", "", "up"}}, {}, {});
    FAIL() << "one was picked";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("--facing left"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("--facing right"), std::string::npos);
  }
}

TEST(AxesReading, IsReadAsItIsWritten) {
  const AxesReading r = parse_axes("-y+z");
  EXPECT_EQ(r, (AxesReading{1, 2, false, true}));
  EXPECT_EQ(r.options(Content::sensors), "--axes=-y+z");
  for (const char* wrong : {"", "xz", "+x+x", "-x+w", "+x+z+"})
    EXPECT_THROW(parse_axes(wrong), InputError) << wrong;
}

TEST_F(SessionOfAModel, ThePalateGivenAsTheTongueIsAFault) {
  const AxesReading reading;
  const SessionFile trace = palate(reading, Content::curves);
  ReadOptions said;
  said.facing = "left", said.up = "up";
  const auto faults = align(*model, trace, trace, said).judgement.faults;
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(faults.back().find("lie on the palate's trace"), std::string::npos) << faults.back();
}

TEST_F(SessionOfAModel, SensorsFarFromTheirPlacesAreAFault) {
  const AxesReading reading;
  ContourFile file = sensors(reading);
  for (ContourPoint& p : file.frames[0].points)
    p.kind = p.kind == "tip" ? "tip+40mm" : p.kind == "blade" ? "tip+53mm" : "tip+75mm";
  file.frames.resize(20, file.frames[0]);  // few frames may all be of one strong posture
  const SessionFile sweep = palate(reading, Content::sensors);
  // Places that are wrong make other axes fit as well, and so they are asked about.
  EXPECT_THROW(align(*model, {"t", file, {}}, sweep, {}), InputError);
  ReadOptions said;
  said.axes = "+x+z";
  EXPECT_FALSE(align(*model, {"t", file, {}}, sweep, said).judgement.faults.empty());
}

TEST_F(SessionOfAModel, SensorsNamedFromTheRootAreAskedAbout) {
  // A short sweep is nearly its own mirror image, so that the names turn the head.
  const std::vector<std::string> places = {"tip+8mm", "tip+20mm", "tip+35mm", "tip+50mm"};
  const AxesReading reading{0, 2, false, true};
  const auto aligned_as = [&](bool from_the_root) {
    std::vector<std::pair<Vec2, std::string>> points;
    for (size_t k = 0; k < places.size(); ++k) {
      const Vec3 rest = place_at_rest(*model, places[k]);
      points.emplace_back(Vec2(rest[0], rest[2]), places[from_the_root ? 3 - k : k]);
    }
    return align(*model, {"t", file_of(points, reading, Content::sensors), {}},
                 palate(reading, Content::sensors), {});
  };
  const auto named = [](const AlignedRecording& a) {
    const auto tells = [](const std::string& line) {
      return line.find("from tip to root?") != std::string::npos;
    };
    return std::any_of(a.file.remarks.begin(), a.file.remarks.end(), tells) ||
           std::any_of(a.judgement.faults.begin(), a.judgement.faults.end(), tells);
  };
  EXPECT_FALSE(named(aligned_as(false)));
  EXPECT_TRUE(named(aligned_as(true)));
}

TEST_F(SessionOfAModel, WithoutAPalateAMirroredHabitIsAskedAbout) {
  const AxesReading true_one{0, 2, false, true};  // as the format has it
  const FileAxes format{"mm", "right", "up"};
  const auto postures = [&](const AxesReading& reading) {
    ContourFile file = contour(reading);
    std::vector<std::pair<Vec2, std::string>> rest;
    for (const Vec2& q : TongueLine(*model).sample(model->rest, 40)) rest.emplace_back(q, "curve");
    rest.erase(rest.begin(), rest.begin() + 8);
    for (int k = 0; k < 3; ++k)
      file.frames.push_back(file_of(rest, reading, Content::curves).frames[0]);
    return file;
  };
  EXPECT_NO_THROW(align(*model, {"t", postures(true_one), format}, {}, {}));
  try {
    ContourFile mirrored = postures({0, 2, true, true});
    mirrored.format.facing_by_habit = true;
    align(*model, {"t", mirrored, format}, {}, {});
    FAIL() << "a mirror image was read as its format's habit has it";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("--facing left"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace genio
