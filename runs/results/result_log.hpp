#pragma once
// One line a frame, on disk as soon as it is known.

#include <optional>
#include <string>

#include "runs/results/answer_record.hpp"
#include "runs/results/line_log.hpp"
#include "runs/results/question.hpp"

namespace genio {

/// DIR/results.jsonl with the answers so far, and DIR/run.json with what was asked. A run that was
/// interrupted leaves both; `resume` takes its lines up and drops one that was cut off.
class ResultLog {
 public:
  /// `asked`: everything that an answer depends on. Throws InputError where the folder holds the
  /// answers to another question or two answers to one frame, or where answers would be overwritten
  /// without `resume`. Another deadline is no other question: where it is later now, the answers
  /// that it had cut off are dropped.
  ResultLog(const std::string& folder, const Question& asked, bool resume);

  /// The answers of the run that is taken up.
  const AnswerRecords& known() const { return known_; }
  void add(const AnswerRecord& answer) { lines_->add(answer.line); }

 private:
  AnswerRecords known_;
  std::optional<LineLog> lines_;  // once it is known whether it may be taken up
};

/// The question of a folder's run.json, as JSON. Throws InputError where it is damaged or missing.
std::string asked_in(const std::string& folder);

/// Adds an answer unless the same is there already: true where it was added. Throws InputError
/// naming frame and `folder` where another answer to the frame is there.
bool add_answer(AnswerRecords& answers, AnswerRecord answer, const std::string& folder);

/// Refuses a folder that holds results, and makes it where there is none. Throws InputError.
void make_result_folder(const std::string& folder, const std::string& otherwise);

}  // namespace genio
