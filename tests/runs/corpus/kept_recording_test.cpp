#include "runs/corpus/kept_recording.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

Measured measured() {
  Measured m;
  m.noise = 0.1 / 3;
  m.head_pose = HeadPosePrior{0.002, 0.1};
  m.registration.forced = true, m.registration.units = "mm";
  m.frames.resize(2);
  ContourFrame &first = m.frames[0], &second = m.frames[1];
  first.number = 3, first.label = "a, \"b\"", first.time_s = 0.1 + 0.2;
  first.recording = "take", first.speaker = "S";
  second.number = 9, second.time_s = not_known, second.note = "lost";
  m.frames[0].points = {{{0.1 / 7, not_known, -1e-3}, 0.3e-3, "curve", {1, 2, 3}, 4}};
  return m;
}

TEST(KeptRecording, GivesFramesBackToTheLastBit) {
  const test::TemporaryFolder folder;
  const Measured m = measured();
  keep_recording(m, {"units mm"}, folder.path());
  const auto frames = kept_frames(folder.path(), 0, 2);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].time_s, m.frames[0].time_s);
  EXPECT_EQ(frames[0].label, m.frames[0].label);
  const ContourPoint &p = frames[0].points.at(0), &q = m.frames[0].points[0];
  EXPECT_EQ(p.position[0], q.position[0]);
  EXPECT_TRUE(std::isnan(p.position[1]));
  EXPECT_EQ(p.sigma, q.sigma);
  EXPECT_EQ(p.rest, q.rest);
  EXPECT_EQ(p.slice, 4);
  EXPECT_TRUE(std::isnan(frames[1].time_s));
  EXPECT_EQ(frames[1].note, "lost");
  EXPECT_EQ(kept_frames(folder.path(), 1, 2).at(0).number, 9);
  const KeptRecording kept = kept_recording(folder.path());
  EXPECT_EQ(kept.noise, m.noise);
  EXPECT_EQ(kept.head_pose.value().turn_sd, 0.1);
  EXPECT_TRUE(kept.forced);
  EXPECT_NE(kept.registration.find("\"units\":\"mm\""), std::string::npos);
  EXPECT_EQ(kept.remarks, std::vector<std::string>{"units mm"});
}

TEST(KeptRecording, IsRefusedWhereItIsMissingOrDamaged) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(kept_recording(folder.path()), InputError);
  EXPECT_THROW(kept_frames(folder.path(), 0, 1), InputError);
  keep_recording(measured(), {}, folder.path());
  EXPECT_THROW(kept_frames(folder.path(), 1, 3), InputError);
  std::ofstream(folder.path() + "/frames.jsonl") << "{\"frame\":1}\n";
  EXPECT_THROW(kept_frames(folder.path(), 0, 1), InputError);
  std::ofstream(folder.path() + "/recording.json") << "[]";
  EXPECT_THROW(kept_recording(folder.path()), InputError);
}

}  // namespace
}  // namespace genio
