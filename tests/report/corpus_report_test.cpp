#include "report/answers/corpus_report.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

AnswerRecord answered(int frame, const std::string& verdict) {
  AnswerView view;
  view.status = verdict == "none" ? "failed" : "converged", view.verdict = verdict;
  if (verdict != "none") view.muscles = {{.name = "GGP", .best = 3, .maximum = 30, .sd = 0.5}};
  return read_record(answer_json(view, frame)).value();
}

class CorpusReport : public testing::Test {
 protected:
  CorpusReport() {
    plan.recordings.resize(3);
    plan.recordings[0].name = "a", plan.recordings[0].file = "s1/a, b.csv";
    plan.recordings[0].frames = {1, 2, 3};
    plan.recordings[1].name = "b", plan.recordings[1].refused = "no palate";
    plan.recordings[2].name = "c", plan.recordings[2].frames = {5};
    for (const char* name : {"a", "c"}) make_folder(folder.path() + "/" + name);
    plan.tasks = {{{0, 0, 3}}, {{2, 0, 1}}};
    results.answers.resize(3);
    results.answers[0] = {
        {1, answered(1, "explained")}, {2, answered(2, "unreachable")}, {3, answered(3, "none")}};
    results.open = {1}, results.failures = {{1, "", "killed"}};
  }
  test::TemporaryFolder folder;
  Plan plan;
  CorpusResults results;
};

TEST_F(CorpusReport, CountsSharesOfAllPlannedFrames) {
  const nlohmann::json json = corpus_json(plan, results);
  EXPECT_EQ(json["frames"], 4);
  EXPECT_EQ(json["answered"], 3);
  for (const char* share : {"explained", "unreachable", "no_answer", "open"})
    EXPECT_EQ(json["shares"][share], 0.25) << share;
  EXPECT_EQ(json["shares"]["mismatch"], 0);
  EXPECT_EQ(json["refused"][0]["reason"], "no palate");
  EXPECT_NEAR(json["refused_share"], 1. / 3, 1e-12);
  EXPECT_EQ(json["failed"][0]["reason"], "killed");
  const std::string text = corpus_text(plan, results);
  EXPECT_NE(text.find("no palate"), std::string::npos);
  EXPECT_NE(text.find("task 1: killed"), std::string::npos);
}

TEST_F(CorpusReport, TheTableHasEachPlannedFrameOnceAndAsManyCellsAsItsHeader) {
  write_corpus(folder.path(), plan, results);
  std::ifstream in(folder.path() + "/results.csv");
  std::vector<std::string> rows;
  for (std::string row; std::getline(in, row);) rows.push_back(row);
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[1].substr(0, 17), "a,\"s1/a, b.csv\",,");
  EXPECT_NE(rows[4].find("c,,,5,,,,open,"), std::string::npos) << rows[4];
  const auto commas = [](const std::string& row) {
    return std::count(row.begin(), row.end(), ',');
  };
  EXPECT_EQ(commas(rows[4]), commas(rows[0]));
  EXPECT_EQ(commas(rows[1]), commas(rows[0]) + 1);  // one in the quoted name
  EXPECT_EQ(commas(rows[3]), commas(rows[0]) + 1);
}

}  // namespace
}  // namespace genio
