// Which frames are asked for, by number, time, TextGrid and label.

#include "runs/frames/frame_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

class FrameChoices : public testing::Test {
 protected:
  /// A hundred a second, from 0 s.
  static std::vector<ContourFrame> timed(int count) {
    std::vector<ContourFrame> frames(static_cast<size_t>(count));
    for (int k = 0; k < count; ++k)
      frames[size_t(k)].number = k + 1, frames[size_t(k)].time_s = 0.01 * k;
    return frames;
  }
  std::string grid(const std::string& name = "take.TextGrid") const {
    const std::string path = folder.path() + "/" + name;
    write_text(
        path,
        "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n0 1 <exists> 2\n"
        "\"IntervalTier\" \"phones\" 0 1 4\n0 0.1 \"\" 0.1 0.3 \"a\" 0.3 0.42 \"t\" 5 6 \"o\"\n"
        "\"TextTier\" \"bursts\" 0 1 2\n0.352 \"t\" 0.353 \"k\"\n");
    return path;
  }
  std::vector<std::string> chosen(std::vector<ContourFrame> frames, const FrameChoice& choice) {
    remarks.clear();
    std::vector<std::string> result;
    for (const ContourFrame& f :
         chosen_frames(std::move(frames), choice, "file.csv",
                       [&](const std::string& line) { remarks.push_back(line); }))
      result.push_back(std::to_string(f.number) + f.label);
    return result;
  }
  std::string refusal(std::vector<ContourFrame> frames, const FrameChoice& choice) {
    try {
      chosen(std::move(frames), choice);
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  }
  using Names = std::vector<std::string>;
  test::TemporaryFolder folder;
  std::vector<std::string> remarks;
};

TEST_F(FrameChoices, ARangeIsOfNumbersOrOfTimes) {
  EXPECT_EQ(chosen(timed(9), {}).size(), 9u);
  EXPECT_EQ(chosen(timed(9), {.frames = "7"}), Names{"7"});
  EXPECT_EQ(chosen(timed(9), {.frames = "3-5"}), (Names{"3", "4", "5"}));
  EXPECT_EQ(chosen(timed(9), {.frames = "0.02s-0.04s"}), (Names{"3", "4", "5"}));
  EXPECT_EQ(chosen(timed(9), {.frames = "0.042s"}), Names{"5"});
}

TEST_F(FrameChoices, ARangeThatIsNoneIsRefused) {
  for (const char* text : {"x", "3-x", "0", "5-3", "3-", "-3", "1.5", "0.2s-3", "2-0.3s", "s",
                           "0.4s-0.2s", "nans", "1e3s-infs"})
    EXPECT_NE(refusal(timed(9), {.frames = text}).find("expected A-B"), std::string::npos) << text;
}

TEST_F(FrameChoices, ARangeWithoutFramesSaysWhatThereIs) {
  EXPECT_NE(refusal(timed(9), {.frames = "12-14"}).find("its frames are 1 to 9"),
            std::string::npos);
  EXPECT_NE(refusal(timed(9), {.frames = "1s-2s"}).find("0.000 to 0.080 s"), std::string::npos);
  EXPECT_NE(refusal(timed(9), {.frames = "1s"}).find("0.000 to 0.080 s"), std::string::npos);
}

TEST_F(FrameChoices, AnIntervalGivesTheFrameNearestToItsMiddle) {
  const FrameChoice choice{.textgrid = grid(), .tier = "phones"};
  EXPECT_EQ(chosen(timed(100), choice), (Names{"21a", "37t"}));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0], "1 of 3 labels lie where there is no frame: o");
}

TEST_F(FrameChoices, PointsThatShareAFrameShareIt) {
  EXPECT_EQ(chosen(timed(100), {.textgrid = grid(), .tier = "bursts"}), Names{"36t + k"});
  EXPECT_EQ(remarks.size(), 1u);
}

TEST_F(FrameChoices, LabelsPickFramesOfAFileOrOfATextGrid) {
  EXPECT_EQ(chosen(timed(100), {.textgrid = grid(), .tier = "phones", .labels = {"t"}}),
            Names{"37t"});
  auto frames = timed(3);
  frames[1].label = "word";
  EXPECT_EQ(chosen(frames, {.labels = {"word"}}), Names{"2word"});
  EXPECT_NE(refusal(frames, {.labels = {"wort"}}).find("did you mean word?"), std::string::npos);
  EXPECT_NE(refusal(timed(3), {.labels = {"word"}}).find("no labels"), std::string::npos);
}

TEST_F(FrameChoices, FramesWithoutTimesAreNotLabelledByTimes) {
  std::vector<ContourFrame> frames(5);
  for (int k = 0; k < 5; ++k) frames[size_t(k)].number = k + 1;
  EXPECT_NE(refusal(frames, {.textgrid = grid(), .tier = "phones"}).find("gives none"),
            std::string::npos);
  EXPECT_NE(refusal(frames, {.frames = "0s-1s"}).find("gives no times"), std::string::npos);
  const auto all = chosen_frames(frames, {}, "file.csv", [](const std::string&) {});
  EXPECT_TRUE(std::isnan(all[0].time_s));
}

TEST_F(FrameChoices, ATextGridIsOfOneRecording) {
  auto frames = timed(80);
  for (size_t k = 0; k < 80; ++k) frames[k].recording = k < 40 ? "one" : "two";
  EXPECT_NE(refusal(frames, {.textgrid = grid(), .tier = "phones"}).find("one, two"),
            std::string::npos);
  EXPECT_EQ(chosen(frames, {.textgrid = grid("one.TextGrid"), .tier = "phones"}),
            (Names{"21a", "37t"}));
}

TEST_F(FrameChoices, AnswersGoByNumbersSoNoTwoFramesHaveTheSame) {
  auto frames = timed(6);
  for (size_t k = 0; k < 6; ++k)
    frames[k].number = int(k) % 3 + 1, frames[k].recording = k < 3 ? "one" : "two";
  EXPECT_NE(refusal(frames, {}).find("--recording"), std::string::npos);
  EXPECT_EQ(chosen(frames, {.recording = "two"}), (Names{"1", "2", "3"}));
  EXPECT_NE(refusal(frames, {.recording = "three"}).find("one, two"), std::string::npos);
  for (auto& f : frames) f.recording.clear();
  EXPECT_NE(refusal(frames, {}).find("two frames 1"), std::string::npos);
}

TEST_F(FrameChoices, OneProblemIsOfOneRecording) {
  auto frames = timed(4);
  EXPECT_NO_THROW(check_one_recording(frames, "--smooth", "file.csv"));
  frames[3].speaker = "B";
  EXPECT_THROW(check_one_recording(frames, "--smooth", "file.csv"), InputError);
}

TEST_F(FrameChoices, OneMovementGoesForwardInTime) {
  auto frames = timed(6);
  EXPECT_NO_THROW(check_times_rise(frames, "--sequence", "file.csv"));
  for (size_t k = 3; k < 6; ++k) frames[k].time_s = 0.01 * double(k - 3);
  EXPECT_THROW(check_times_rise(frames, "--sequence", "file.csv"), InputError);
  for (auto& f : frames) f.time_s = std::nan("");
  EXPECT_NO_THROW(check_times_rise(frames, "--sequence", "file.csv"));
}

TEST_F(FrameChoices, ARangeBeyondTheLastFrameIsTold) {
  EXPECT_EQ(chosen(timed(4), {.frames = "3-9"}), (Names{"3", "4"}));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("the last frame there is 4"), std::string::npos);
  chosen(timed(4), {.frames = "3-4"});
  EXPECT_TRUE(remarks.empty());
  auto gap = timed(4);
  gap[2].number = 20, gap[3].number = 21;
  chosen(gap, {.frames = "1-3"});
  EXPECT_TRUE(remarks.empty());
}

TEST_F(FrameChoices, ATierIsOfATextGrid) {
  EXPECT_NE(refusal(timed(3), {.tier = "phones"}).find("--textgrid"), std::string::npos);
}

}  // namespace
}  // namespace genio
