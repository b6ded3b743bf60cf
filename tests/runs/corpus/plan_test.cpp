// Which task answers which frame.

#include "runs/corpus/plan.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

PlannedRecording recording(int frames, const std::string& model = "m", bool whole = false) {
  PlannedRecording r;
  r.name = "r" + std::to_string(frames), r.model = model, r.whole = whole;
  r.frames.resize(size_t(frames));
  std::iota(r.frames.begin(), r.frames.end(), 1);
  return r;
}

/// How often each frame of each recording is answered.
std::map<std::pair<int, int>, int> times_answered(const std::vector<Task>& tasks) {
  std::map<std::pair<int, int>, int> times;
  for (const Task& task : tasks)
    for (const Piece& p : task)
      for (int f = p.first; f < p.end; ++f) ++times[{p.recording, f}];
  return times;
}

TEST(PlanOfACorpus, CoversEachFrameExactlyOnce) {
  const std::vector<PlannedRecording> recordings = {recording(7),      recording(0),
                                                    recording(1, "n"), recording(23, "m", true),
                                                    recording(100),    recording(5, "n")};
  for (const int share : {1, 3, 7, 50, 1000}) {
    const auto times = times_answered(cut(recordings, share));
    EXPECT_EQ(times.size(), 136u);
    for (const auto& [frame, n] : times) EXPECT_EQ(n, 1) << share;
  }
}

TEST(PlanOfACorpus, SharesAreAboutEvenAndNeverEmpty) {
  const std::vector<PlannedRecording> recordings = {recording(31), recording(3), recording(90)};
  const auto tasks = cut(recordings, 20);
  EXPECT_EQ(tasks.size(), 7u);
  for (const Task& task : tasks) {
    EXPECT_LE(frames_of(task), 20);
    EXPECT_GT(frames_of(task), 0);
  }
}

TEST(PlanOfACorpus, FramesThatHangTogetherStayTogether) {
  const std::vector<PlannedRecording> recordings = {recording(4), recording(30, "m", true),
                                                    recording(4)};
  int pieces = 0, frames = 0;
  for (const Task& task : cut(recordings, 5))
    for (const Piece& p : task)
      if (p.recording == 1) ++pieces, frames += p.end - p.first;
  EXPECT_EQ(pieces, 1);
  EXPECT_EQ(frames, 30);
}

TEST(PlanOfACorpus, RecordingsOfOneModelFollowOneAnother) {
  std::vector<std::string> order;
  const std::vector<PlannedRecording> recordings = {recording(4, "b"), recording(4, "a"),
                                                    recording(4, "b"), recording(4, "a")};
  for (const Task& task : cut(recordings, 3))
    for (const Piece& p : task)
      if (const std::string& model = recordings[size_t(p.recording)].model;
          order.empty() || order.back() != model)
        order.push_back(model);
  EXPECT_EQ(order, (std::vector<std::string>{"a", "b"}));
}

TEST(PlanOfACorpus, ShareGrowsWithTheCorpusAndTasksStayFew) {
  int before = 0;
  for (const int frames : {1, 100, 1000, 10000, 1000000}) {
    const int share = usual_share(frames);
    EXPECT_GE(share, before);
    EXPECT_LE((frames + share - 1) / share, 1000);
    before = share;
  }
}

TEST(PlanOfACorpus, IsReadAsItWasWrittenAndNotWhereItIsDamaged) {
  const test::TemporaryFolder folder;
  Plan plan{"/somewhere", 5, {recording(4), recording(30, "m", true)}, {}};
  plan.recordings[0].refused = "why", plan.recordings[1].question = R"({"starts":3})";
  plan.recordings[1].words = {"--target", "a \"b\".csv"};
  plan.tasks = cut(plan.recordings, 5);
  write_plan(plan, folder.path());
  const Plan read = read_plan(folder.path());
  EXPECT_EQ(read.recordings[1].words, plan.recordings[1].words);
  EXPECT_EQ(read.recordings[1].question, plan.recordings[1].question);
  EXPECT_EQ(read.recordings[1].frames, plan.recordings[1].frames);
  EXPECT_TRUE(read.recordings[1].whole);
  EXPECT_EQ(read.recordings[0].refused, "why");
  EXPECT_EQ(times_answered(read.tasks), times_answered(plan.tasks));
  EXPECT_THROW(read_plan(folder.path() + "/nowhere"), InputError);
  plan.tasks.push_back({{1, 0, 31}});
  write_plan(plan, folder.path());
  EXPECT_THROW(read_plan(folder.path()), InputError);
  write_text(folder.path() + "/plan.json", "{\"share\": 3");
  EXPECT_THROW(read_plan(folder.path()), InputError);
}

}  // namespace
}  // namespace genio
