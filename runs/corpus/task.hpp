#pragma once
// One task of a corpus: its share of the frames, answered one after another.

#include "inverse/search/infer_workspace.hpp"
#include "runs/corpus/planning.hpp"

namespace genio {

/// Writes the files of answers into the folder of their recording; `frame` gives the line that
/// answer_json() makes, first, and whatever it likes below.
struct AnswerFiles {
  std::function<std::string(const Model&, const ContourFrame&, const AnswerView&,
                            const Positions& shape, const std::string& folder)>
      frame;
  std::function<void(const Model&, const MotionAnswer&, const std::string& folder)> movement;
};

/// Answers the frames of task `k` that its lines do not hold yet. Each line is on disk as soon as
/// it is known, so that the task may be killed and started again at any time; two that work on
/// it at once wait for one another. `step` is called with every answer. What goes wrong with one
/// recording stands in failures_of(), and the others go on. Throws the first of what went wrong.
void run_task(const std::string& out, const Plan& plan, int k, const ReadWords& read,
              Models& models, const AnswerFiles& files, const std::function<void()>& step);

/// What went wrong in the last run of a task.
struct TaskFailure {
  int task = 0;
  std::string recording;  ///< empty: the task as a whole
  std::string reason;
};
std::vector<TaskFailure> failures_of(const std::string& out, int k);
void write_failures(const std::string& out, int k, const std::vector<TaskFailure>& failures);

}  // namespace genio
