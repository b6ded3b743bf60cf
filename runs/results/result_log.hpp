#pragma once
// One line a frame, on disk as soon as it is known.

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "runs/results/answer_record.hpp"
#include "runs/results/line_log.hpp"

namespace genio {

/// What was asked: each option's name and value, in any order; std::monostate where it is unset.
using QuestionValue =
    std::variant<std::monostate, bool, int, double, std::string, std::vector<std::string>>;
using Question = std::vector<std::pair<std::string, QuestionValue>>;

/// DIR/results.jsonl with the answers so far, and DIR/run.json with what was asked. A run that was
/// interrupted leaves both; `resume` takes its lines up and drops one that was cut off.
class ResultLog {
 public:
  /// `asked`: everything that an answer depends on. Throws InputError where the folder holds the
  /// answers to another question, or where answers would be overwritten without `resume`.
  ResultLog(const std::string& folder, const Question& asked, bool resume);

  /// The answers of the run that is taken up.
  const AnswerRecords& known() const { return known_; }
  void add(const AnswerRecord& answer) { lines_->add(answer.line); }

 private:
  AnswerRecords known_;
  std::optional<LineLog> lines_;  // once it is known whether it may be taken up
};

}  // namespace genio
