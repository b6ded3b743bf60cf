#pragma once
// What the tasks of a corpus have left so far.

#include "runs/corpus/plan.hpp"
#include "runs/corpus/task.hpp"
#include "runs/results/answer_record.hpp"

namespace genio {

struct CorpusResults {
  std::vector<AnswerRecords> answers;  ///< of each recording of the plan
  std::vector<int> open;               ///< tasks with frames that have no answer
  std::vector<TaskFailure> failures;   ///< of open tasks, each with at least one reason
  double wall_s = 0, cpu_s = 0;        ///< summed over the runs of tasks that came to their end
};

/// Reads the lines of all tasks. Throws InputError where they answer another question than the
/// plan's, or one frame twice and differently.
CorpusResults corpus_results(const std::string& out, const Plan& plan);

/// Writes run.json and results.jsonl of every recording with answers into its folder, each frame
/// once and in their order.
void write_results(const std::string& out, const Plan& plan, const CorpusResults& results);

}  // namespace genio
