// Runs over several ranges of frames as one, and what makes two runs the same question.

#include "runs/results/merged_runs.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "runs/results/content_hash.hpp"
#include "runs/results/result_log.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

class MergedRunsOf : public testing::Test {
 protected:
  static AnswerRecord answer(int frame, double force) {
    AnswerView view;
    view.status = "converged", view.verdict = "explained";
    view.muscles = {{.name = "GGP", .best = force, .maximum = 30, .sd = 0.5}};
    return read_record(answer_json(view, frame)).value();
  }
  std::string run(const std::string& name, const std::vector<int>& frames, double force = 1,
                  int starts = 3) const {
    const std::string path = folder.path() + "/" + name;
    ResultLog log(path, {{"starts", starts}}, false);
    for (int frame : frames) {
      log.add(answer(frame, force));
      write_text(path + "/" + frame_name(frame) + ".json", name);
    }
    return path;
  }
  std::string refusal(const std::vector<std::string>& folders) const {
    try {
      merged_runs(folders);
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  }
  test::TemporaryFolder folder;
};

TEST_F(MergedRunsOf, EveryFrameIsThereOnceInOrder) {
  const MergedRuns runs = merged_runs({run("b", {4, 5}), run("a", {1, 2, 4}, 1.01)});
  const std::string out = folder.path() + "/out";
  write_merged(runs, out);
  const ResultLog log(out, {{"starts", 3}}, true);
  std::vector<int> frames;
  for (const auto& [frame, record] : log.known()) frames.push_back(frame);
  EXPECT_EQ(frames, (std::vector{1, 2, 4, 5}));
  EXPECT_EQ(log.known().at(4).forces_N.at("GGP"), 1);
  for (int frame : frames)
    EXPECT_TRUE(std::filesystem::exists(out + "/" + frame_name(frame) + ".json"));
}

TEST_F(MergedRunsOf, TwoAnswersToOneFrameAreRefusedByName) {
  const std::string what = refusal({run("a", {1, 2}), run("b", {2, 3}, 5)});
  EXPECT_NE(what.find("frame 2"), std::string::npos) << what;
  EXPECT_NE(what.find("/a and another in"), std::string::npos) << what;
}

TEST_F(MergedRunsOf, TwoQuestionsAreRefusedByName) {
  const std::string what = refusal({run("a", {1}), run("b", {2}, 1, 4)});
  EXPECT_NE(what.find("/a was made with starts = 3, not 4 as in"), std::string::npos) << what;
}

TEST_F(MergedRunsOf, ALineCutOffIsDroppedAndAnyOtherIsNamed) {
  const std::string a = run("a", {1, 2});
  std::ofstream(a + "/results.jsonl", std::ios::app) << "{\"frame\":3,\"sta";
  EXPECT_EQ(merged_runs({a}).answers.size(), 2u);
  std::ofstream(a + "/results.jsonl", std::ios::app) << "\n";
  EXPECT_NE(refusal({a}).find("results.jsonl:3: is no answer"), std::string::npos) << refusal({a});
}

TEST_F(MergedRunsOf, AFolderWithoutARunIsNamed) {
  EXPECT_NE(refusal({folder.path()}).find("expected the folder of a run"), std::string::npos);
  const std::string a = run("a", {1});
  EXPECT_THROW(write_merged(merged_runs({a}), a), InputError);
}

TEST_F(MergedRunsOf, AFileCountsByItsContentAndNotByItsName) {
  const std::string a = folder.path() + "/a.csv", b = folder.path() + "/b.csv";
  write_text(a, "one"), write_text(b, "one");
  const auto asked = [](const std::string& path) {
    return question_json({{"target", asked_file(path)}});
  };
  const std::string before = asked(a);
  EXPECT_EQ(difference(before, asked(b)), "");
  write_text(b, "two");
  EXPECT_NE(difference(before, asked(b)), "");
  EXPECT_EQ(difference(asked(""), asked("")), "");
  EXPECT_NE(difference(asked(""), asked(a)), "");
}

TEST_F(MergedRunsOf, WhatATomlFileNamesCountsAsItsContent) {
  const std::string path = folder.path() + "/model.toml";
  write_text(path, "mesh = \"mesh.vtu\"\nname = \"nothing\"\n");
  write_text(folder.path() + "/mesh.vtu", "one");
  const std::string before = content_hash(path);
  EXPECT_EQ(content_hash(folder.path()), before);
  write_text(folder.path() + "/mesh.vtu", "two");
  EXPECT_NE(content_hash(path), before);
}

}  // namespace
}  // namespace genio
