// Reading a corpus: what is refused, what is read again, and what has changed.

#include "runs/corpus/planning.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "forward/base/text_file.hpp"
#include "runs/corpus/corpus_results.hpp"
#include "runs/corpus/kept_recording.hpp"
#include "runs/results/result_log.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

class PlannedCorpus : public testing::Test {
 protected:
  PlannedCorpus() {
    for (const char* name : {"a", "b", "c"}) fs::copy_file(example, file(name));
    write_text(file("bad"), "frame,point,x_mm,z_mm\n1,1,far,2\n");
  }
  std::string file(const std::string& name) const { return folder.path() + "/" + name + ".csv"; }
  std::string out() const { return folder.path() + "/out"; }
  static InversionOptions take(const std::vector<std::string>& words) {
    InversionOptions o;
    o.model = GENIO_SOURCE_DIR "/data/generic/model.toml";
    for (size_t k = 0; k + 1 < words.size(); ++k) {
      if (words[k] == "--target") o.measured.target = words[k + 1];
      if (words[k] == "--starts") o.starts = std::stoi(words[k + 1]);
      if (words[k] == "--labels") o.measured.choice.labels = {words[k + 1]};
    }
    return o;
  }
  Plan plan(const std::string& rows, bool resume = false) {
    write_text(folder.path() + "/m.csv", "recording,speaker,options\n" + rows);
    read.clear();
    return plan_corpus(read_manifest(folder.path() + "/m.csv", take), out(),
                       {.share = 1, .processes = 2, .resume = resume}, take, models,
                       [&](const PlannedRecording& r, int, int) { read.push_back(r.name); });
  }
  std::string refusal(const std::string& rows, bool resume) {
    try {
      plan(rows, resume);
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  }
  const std::string example = GENIO_SOURCE_DIR "/data/examples/example_shape.csv";
  test::TemporaryFolder folder;
  Models models;
  std::vector<std::string> read;
};

TEST_F(PlannedCorpus, WhatCannotBeReadIsRefusedAndTheRestGoesOn) {
  const Plan p = plan("a.csv,S1,\nbad.csv,S1,\nb.csv,S2,\n");
  ASSERT_EQ(p.recordings.size(), 3u);
  EXPECT_NE(p.recordings[1].refused.find("bad.csv:2: field x_mm"), std::string::npos)
      << p.recordings[1].refused;
  EXPECT_EQ(p.recordings[0].frames, std::vector{1});
  EXPECT_EQ(p.tasks.size(), 2u);
  const auto frames = kept_frames(out() + "/b", 0, 1);
  EXPECT_EQ(frames[0].speaker, "S2");
  EXPECT_EQ(frames[0].recording, "b");
  EXPECT_THROW(kept_frames(out() + "/b", 0, 2), InputError);
}

TEST_F(PlannedCorpus, OnlyNewAndRefusedRecordingsAreReadAgain) {
  const Plan before = plan("a.csv,S1,\nbad.csv,S1,\n");
  EXPECT_NE(refusal("a.csv,S1,\n", false).find("holds a corpus already"), std::string::npos);
  fs::copy_file(example, file("bad"), fs::copy_options::overwrite_existing);
  const Plan after = plan("a.csv,S1,\nbad.csv,S1,\nc.csv,S1,\n", true);
  std::sort(read.begin(), read.end());
  EXPECT_EQ(read, (std::vector<std::string>{"bad", "c"}));
  EXPECT_EQ(after.recordings[1].refused, "");
  ASSERT_EQ(after.tasks.size(), 3u);
  EXPECT_EQ(after.tasks[0][0].recording, before.tasks[0][0].recording);
}

TEST_F(PlannedCorpus, AChangedRecordingOrOptionIsNoticed) {
  plan("a.csv,S1,\nb.csv,S1,\n");
  EXPECT_EQ(refusal("a.csv,S1,\nb.csv,S1,\n", true), "none");
  EXPECT_NE(refusal("a.csv,S1,--starts 3\nb.csv,S1,\n", true)
                .find("m.csv:2: a was planned with starts = 0, not 3"),
            std::string::npos);
  EXPECT_NE(refusal("a.csv,S1,--labels x\nb.csv,S1,\n", true).find("planned with frames"),
            std::string::npos);
  EXPECT_NE(refusal("a.csv,S1,\nb.csv,S2,\n", true).find("planned with speaker"),
            std::string::npos);
  EXPECT_NE(refusal("a.csv,S1,\n", true).find("lacks b.csv"), std::string::npos);
  std::ofstream(file("b"), std::ios::app) << "1,99,100,100,0.3,\n";
  EXPECT_NE(refusal("a.csv,S1,\nb.csv,S1,\n", true).find("whose content is not that of"),
            std::string::npos);
}

TEST_F(PlannedCorpus, ARecordingWhoseFolderIsRemovedIsPlannedAnew) {
  const Plan before = plan("a.csv,S1,\nb.csv,S1,\n");
  const std::string lines = lines_folder(out(), 1, before.recordings[1]);
  make_folder(lines);
  fs::remove_all(out() + "/b");
  const Plan after = plan("a.csv,S1,\nb.csv,S1,--starts 3\n", true);
  EXPECT_EQ(read, std::vector<std::string>{"b"});
  EXPECT_FALSE(fs::exists(lines));
  ASSERT_EQ(after.tasks.size(), 3u);
  EXPECT_TRUE(after.tasks[1].empty());
  EXPECT_EQ(after.tasks[2][0].recording, 1);
}

/// A line of results of one frame.
AnswerRecord line_of(int frame, double force = 1) {
  AnswerView view;
  view.status = "converged", view.verdict = "explained";
  view.muscles = {{.name = "GGP", .best = force, .maximum = 30, .sd = 0.5}};
  return read_record(answer_json(view, frame)).value();
}

TEST_F(PlannedCorpus, ATaskIsOpenUntilItsFramesAreThereAndNothingIsThereTwice) {
  const Plan p = plan("a.csv,S1,\nb.csv,S1,\n");
  write_failures(out(), 0, {{0, "a", "the disk is full"}});
  const CorpusResults before = corpus_results(out(), p);
  EXPECT_EQ(before.open, (std::vector{0, 1}));
  ASSERT_EQ(before.failures.size(), 2u);
  EXPECT_EQ(before.failures[0].reason, "the disk is full");
  EXPECT_NE(before.failures[1].reason.find("has not come to its end"), std::string::npos);
  // A line that another task left of the same frame, and one cut off, count once and not at all.
  const PlannedRecording& a = p.recordings[0];
  const Question asked = planned_question(take({"--target", file("a")}), a.noise, a);
  for (const int task : {0, 0})
    ResultLog(lines_folder(out(), task, a), asked, true).add(line_of(1));
  std::ofstream(lines_folder(out(), 0, a) + "/results.jsonl", std::ios::app) << "{\"frame\":2,\"st";
  const CorpusResults some = corpus_results(out(), p);
  EXPECT_EQ(some.open, std::vector{1});
  EXPECT_EQ(some.answers[0].size(), 1u);
  write_results(out(), p, some);
  std::ifstream lines(out() + "/a/results.jsonl");
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(lines), {}, '\n'), 1);
}

TEST_F(PlannedCorpus, AnswersToAnotherQuestionAreRefused) {
  const Plan p = plan("a.csv,S1,\n");
  ResultLog(lines_folder(out(), 0, p.recordings[0]), {{"starts", 7}}, true).add(line_of(1));
  EXPECT_THROW(corpus_results(out(), p), InputError);
}

}  // namespace
}  // namespace genio
