#include "runs/corpus/corpus_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"
#include "runs/results/merged_runs.hpp"
#include "runs/results/result_log.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

/// A task that was stopped before its first line has none.
bool has_lines(const std::string& folder) {
  std::error_code none;
  return fs::exists(folder + "/results.jsonl", none) &&
         fs::file_size(folder + "/results.jsonl", none) > 0;
}

/// Answers to the planned frames of a recording.
AnswerRecords answers_of(const PlannedRecording& r, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders)
    if (const std::string other = difference(r.question, asked_in(folder)); !other.empty())
      throw InputError(fmt::format("{}: was planned with {}; remove it, and --resume answers anew",
                                   folder, other));
  AnswerRecords planned;
  if (folders.empty()) return planned;
  AnswerRecords all = answers_in(folders).answers;
  for (const int frame : r.frames)
    if (auto found = all.extract(frame)) planned.insert(std::move(found));
  return planned;
}

bool is_open(const Plan& plan, const Task& task, const std::vector<AnswerRecords>& answers) {
  return std::any_of(task.begin(), task.end(), [&](const Piece& p) {
    const auto& frames = plan.recordings[size_t(p.recording)].frames;
    return std::any_of(frames.begin() + p.first, frames.begin() + p.end,
                       [&](int frame) { return !answers[size_t(p.recording)].contains(frame); });
  });
}

void add_times(const std::string& folder, CorpusResults& results) {
  std::ifstream in(folder + "/time.jsonl");
  for (std::string line; std::getline(in, line);) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object()) continue;
    results.wall_s += json.value("wall_s", 0.), results.cpu_s += json.value("cpu_s", 0.);
  }
}

std::vector<TaskFailure> reasons(const std::string& out, int task) {
  std::vector<TaskFailure> failures = failures_of(out, task);
  if (!failures.empty()) return failures;
  const std::string log = fmt::format("{}/slurm/task_{}.log", out, task);
  return {{task, "",
           "it has not come to its end" + (fs::exists(log) ? "; see " + log : std::string())}};
}

}  // namespace

CorpusResults corpus_results(const std::string& out, const Plan& plan) {
  std::vector<std::vector<std::string>> folders(plan.recordings.size());
  CorpusResults results;
  for (size_t t = 0; t < plan.tasks.size(); ++t) {
    for (const Piece& p : plan.tasks[t]) {
      const auto r = size_t(p.recording);
      const std::string folder = lines_folder(out, int(t), plan.recordings[r]);
      if (has_lines(folder)) folders[r].push_back(folder);
    }
    add_times(task_folder(out, int(t)), results);
  }
  for (size_t r = 0; r < plan.recordings.size(); ++r)
    results.answers.push_back(answers_of(plan.recordings[r], folders[r]));
  for (size_t t = 0; t < plan.tasks.size(); ++t) {
    if (!is_open(plan, plan.tasks[t], results.answers)) continue;
    results.open.push_back(int(t));
    for (TaskFailure& f : reasons(out, int(t))) results.failures.push_back(std::move(f));
  }
  return results;
}

void write_results(const std::string& out, const Plan& plan, const CorpusResults& results) {
  for (size_t r = 0; r < plan.recordings.size(); ++r) {
    if (results.answers[r].empty()) continue;
    std::string lines;
    for (const auto& [frame, answer] : results.answers[r]) lines += answer.line + "\n";
    const std::string folder = out + "/" + plan.recordings[r].name;
    write_text(folder + "/run.json", plan.recordings[r].question + "\n");
    write_text(folder + "/results.jsonl", lines);
  }
}

}  // namespace genio
