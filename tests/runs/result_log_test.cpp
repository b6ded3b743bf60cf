#include "runs/results/result_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "runs/frames/frame.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

class ResultLogs : public testing::Test {
 protected:
  static AnswerRecord answer(int frame) {
    AnswerView view;
    view.status = "converged", view.verdict = "explained";
    view.muscles = {{.name = "GGP", .best = 0.1 * frame, .maximum = 30}};
    return read_record(answer_json(view, frame)).value();
  }
  static std::vector<Frame> frames(int count) {
    std::vector<Frame> result(static_cast<size_t>(count));
    for (int k = 0; k < count; ++k) result[size_t(k)].contour.number = k + 1;
    return result;
  }
  std::string text(const std::string& name) const {
    return test::content_of(folder.path() + "/" + name);
  }
  test::TemporaryFolder folder;
  const Question asked = {{"model", "m"}, {"starts", 3}, {"robust", false}, {"start_s", {}}};
};

TEST_F(ResultLogs, ResumingAnswersWhatIsMissingAndOnlyThat) {
  {
    ResultLog log(folder.path(), asked, false);
    for (int frame : {1, 2, 4}) log.add(answer(frame));
  }
  const ResultLog log(folder.path(), asked, true);
  const auto open = open_frames(frames(5), log.known());
  ASSERT_EQ(open.size(), 2u);
  EXPECT_EQ(open[0].contour.number, 3);
  EXPECT_EQ(open[1].contour.number, 5);
}

TEST_F(ResultLogs, AnAnswerCutOffInMidLineIsGivenAgain) {
  {
    ResultLog log(folder.path(), asked, false);
    for (int frame : {1, 2}) log.add(answer(frame));
  }
  const std::string whole = text("results.jsonl");
  write_text(folder.path() + "/results.jsonl", whole.substr(0, whole.size() - 9));
  {
    ResultLog log(folder.path(), asked, true);
    EXPECT_EQ(log.known().size(), 1u);
    log.add(answer(2));
  }
  EXPECT_EQ(text("results.jsonl"), whole);
}

TEST_F(ResultLogs, KnownAnswersStayAsTheyWereWritten) {
  {
    ResultLog log(folder.path(), asked, false);
    log.add(answer(1));
  }
  const std::string before = text("results.jsonl");
  const ResultLog log(folder.path(), asked, true);
  EXPECT_EQ(text("results.jsonl"), before);
  EXPECT_EQ(log.known().at(1).line + "\n", before);
}

TEST_F(ResultLogs, AnotherDeadlineIsNoOtherQuestionAndALaterOneAnswersWhatWasCutOff) {
  const auto until = [&](double seconds) {
    Question question = asked;
    question.emplace_back("deadline_s", seconds);
    return question;
  };
  AnswerView cut_off;
  cut_off.status = "deadline", cut_off.verdict = "none";
  {
    ResultLog log(folder.path(), until(2), false);
    log.add(answer(1));
    log.add(read_record(answer_json(cut_off, 2)).value());
  }
  EXPECT_EQ(ResultLog(folder.path(), until(1), true).known().size(), 2u);
  EXPECT_EQ(ResultLog(folder.path(), until(1), true).known().size(), 2u);
  ResultLog log(folder.path(), until(0), true);
  EXPECT_EQ(log.known().size(), 1u);
  log.add(answer(2));
  EXPECT_EQ(ResultLog(folder.path(), until(5), true).known().size(), 2u);
}

TEST_F(ResultLogs, ResultsAreNotOverwrittenUnasked) {
  { ResultLog log(folder.path(), asked, false); }
  EXPECT_THROW(ResultLog(folder.path(), asked, false), InputError);
}

TEST_F(ResultLogs, AnotherQuestionIsRefusedByItsName) {
  { ResultLog log(folder.path(), asked, false); }
  Question other = asked;
  other[1].second = 4;
  try {
    ResultLog log(folder.path(), other, true);
    FAIL() << "another question was taken up";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("was made with starts = 3, not 4"), std::string::npos)
        << e.what();
  }
}

TEST_F(ResultLogs, AnotherContentOfAFileIsAnotherQuestion) {
  test::TemporaryFolder elsewhere;
  const std::string target = elsewhere.path() + "/target.csv";
  write_text(target, "1");
  { ResultLog log(folder.path(), {{"target", asked_file(target)}}, false); }
  EXPECT_NO_THROW(ResultLog(folder.path(), {{"target", asked_file(target)}}, true));
  write_text(target, "2");
  EXPECT_THROW(ResultLog(folder.path(), {{"target", asked_file(target)}}, true), InputError);
}

TEST_F(ResultLogs, AnAnswerThatIsThereTwiceIsKeptOnceAndTwoThatDifferAreRefused) {
  {
    ResultLog log(folder.path(), asked, false);
    for (int frame : {1, 2, 1}) log.add(answer(frame));
  }
  const std::string path = folder.path() + "/results.jsonl";
  { EXPECT_EQ(ResultLog(folder.path(), asked, true).known().size(), 2u); }
  EXPECT_EQ(text("results.jsonl"), answer(1).line + "\n" + answer(2).line + "\n");
  AnswerView other;
  other.status = "failed", other.verdict = "none";
  std::ofstream(path, std::ios::app) << answer_json(other, 2) << "\n";
  EXPECT_THROW(ResultLog(folder.path(), asked, true), InputError);
}

TEST_F(ResultLogs, ADamagedQuestionIsAnErrorOfTheInput) {
  { ResultLog log(folder.path(), asked, false); }
  write_text(folder.path() + "/run.json", "[1");
  EXPECT_THROW(ResultLog(folder.path(), asked, true), InputError);
}

TEST(AnswerRecords, ARecordHoldsTheNumbersOfItsAnswer) {
  AnswerView view;
  view.status = "converged", view.verdict = "mismatch";
  view.rms_mm = 0.1 + 0.2, view.max_mm = 2, view.chi2_per_dof = 1e-7, view.wall_s = 3;
  view.muscles = {{.name = "HG", .best = 1.0 / 3, .maximum = 7, .sd = 0.25}};
  view.others = {{.name = "gravity.z", .best = -9.81, .unit = "m/s^2"}};
  const auto r = read_record(answer_json(view, 7));
  ASSERT_TRUE(r);
  EXPECT_EQ(r->frame, 7);
  EXPECT_TRUE(r->converged());
  EXPECT_EQ(r->verdict, "mismatch");
  EXPECT_EQ(r->rms_mm, view.rms_mm);
  EXPECT_EQ(r->chi2_per_dof, view.chi2_per_dof);
  EXPECT_EQ(r->forces_N.at("HG"), 1.0 / 3);
  EXPECT_EQ(r->sd_N.at("HG"), 0.25);
  EXPECT_EQ(r->activation.at("HG"), 1.0 / 3 / 7);
  EXPECT_EQ(r->estimated.at("gravity.z"), -9.81);
}

TEST(AnswerRecords, ARecordHoldsTimeAndWordsOfItsFrame) {
  ContourFrame frame;
  frame.number = 7, frame.time_s = 1.25, frame.label = "k\xE4se";  // Latin-1
  frame.recording = "take 3", frame.speaker = "S2";
  AnswerView view;
  tell_frame(frame, view);
  EXPECT_EQ(view.title, "frame 7 at 1.250 s: k\xC3\xA4se (take 3, speaker S2)");
  const auto r = read_record(answer_json(view, 7));
  ASSERT_TRUE(r);
  EXPECT_EQ(r->time_s, 1.25);
  EXPECT_EQ(r->label, "k\xC3\xA4se");
  EXPECT_EQ(r->recording, "take 3");
  EXPECT_EQ(r->speaker, "S2");
  frame.time_s = std::nan("");
  tell_frame(frame, view);
  EXPECT_TRUE(std::isnan(read_record(answer_json(view, 7))->time_s));
}

TEST(AnswerRecords, WhatIsNoAnswerIsNone) {
  for (const char* line : {"", "{", "[1]", "{\"case\":1}", "{\"frame\":\"x\"}", "{\"frame\":1"})
    EXPECT_FALSE(read_record(line)) << line;
}

}  // namespace
}  // namespace genio
