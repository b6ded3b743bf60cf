#pragma once
#include <map>
#include <string>
#include <vector>

#include "runs/results/answer_record.hpp"

namespace genio {

/// Runs of one question over several ranges of frames, as one.
struct MergedRuns {
  std::string question;  ///< as JSON
  AnswerRecords answers;
  std::map<int, std::string> folder;  ///< which run each frame's answer is of
};

/// Reads the folders of runs. Throws InputError naming the folder where one holds no run, where two
/// differ in what was asked, or where two answers to one frame differ.
MergedRuns answers_in(const std::vector<std::string>& folders);
/// The same, and throws InputError where they hold no answer.
MergedRuns merged_runs(const std::vector<std::string>& folders);

/// Writes run.json, results.jsonl and copies of the files of each frame into `out`, which must not
/// hold results yet. Throws InputError.
void write_merged(const MergedRuns& runs, const std::string& out);

}  // namespace genio
