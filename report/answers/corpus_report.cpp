#include "report/answers/corpus_report.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "forward/base/text_file.hpp"
#include "report/answers/run_summary.hpp"
#include "runs/text/csv_text.hpp"

namespace genio {
namespace {

using Json = nlohmann::json;

/// How many frames have each status and verdict; "open" are those without an answer.
struct FrameCounts {
  int frames = 0, answered = 0, doubtful = 0;
  std::map<std::string, int> status, verdict;

  void add(const PlannedRecording& r, const AnswerRecords& answers) {
    frames += int(r.frames.size()), answered += int(answers.size());
    for (const auto& [frame, a] : answers) {
      ++status[a.status], ++verdict[a.converged() ? a.verdict : "none"];
      doubtful += a.registration.doubtful;
    }
    const int open = int(r.frames.size() - answers.size());
    if (open > 0) status["open"] += open;
  }
  int of(const std::string& name) const {
    const auto it = verdict.find(name);
    return it == verdict.end() ? 0 : it->second;
  }
};

FrameCounts all_frames(const Plan& plan, const CorpusResults& results) {
  FrameCounts counts;
  for (size_t r = 0; r < plan.recordings.size(); ++r)
    counts.add(plan.recordings[r], results.answers[r]);
  return counts;
}

Json shares_json(const FrameCounts& c) {
  Json shares;
  const auto share = [&](int n) { return c.frames > 0 ? double(n) / c.frames : 0; };
  for (const char* verdict : {"explained", "unreachable", "mismatch"})
    shares[verdict] = share(c.of(verdict));
  shares["no_answer"] = share(c.of("none")), shares["open"] = share(c.frames - c.answered);
  return shares;
}

Json recording_json(const PlannedRecording& r, const AnswerRecords& answers) {
  FrameCounts counts;
  counts.add(r, answers);
  return {{"recording", r.name},     {"file", r.file},
          {"line", r.line},          {"speaker", r.speaker},
          {"frames", counts.frames}, {"answered", counts.answered},
          {"status", counts.status}, {"verdict", counts.verdict},
          {"refused", r.refused}};
}

Json refused_json(const Plan& plan) {
  Json refused = Json::array();
  for (const PlannedRecording& r : plan.recordings)
    if (!r.refused.empty())
      refused.push_back(
          {{"recording", r.name}, {"file", r.file}, {"line", r.line}, {"reason", r.refused}});
  return refused;
}

Json failed_json(const CorpusResults& results) {
  Json failed = Json::array();
  for (const TaskFailure& f : results.failures)
    failed.push_back({{"task", f.task}, {"recording", f.recording}, {"reason", f.reason}});
  return failed;
}

/// All muscles of all models, in alphabetical order.
std::set<std::string> muscles_of(const CorpusResults& results) {
  std::set<std::string> muscles;
  for (const AnswerRecords& answers : results.answers)
    for (const auto& [frame, a] : answers)
      for (const auto& [name, force] : a.forces_N) muscles.insert(name);
  return muscles;
}

/// The row of a planned frame; without an answer it is open, and its numbers are empty.
std::string frame_row(const PlannedRecording& r, int frame, const AnswerRecord* a,
                      const std::set<std::string>& muscles) {
  std::string row =
      fmt::format("{},{},{},{}", csv_field(r.name), csv_field(r.file),
                  csv_field(a && !a->speaker.empty() ? a->speaker : r.speaker), frame);
  const std::string titles = laid_titles();
  const auto commas = size_t(std::count(titles.begin(), titles.end(), ','));
  if (!a) return row + ",,,,open" + std::string(5 + commas + 7 * muscles.size(), ',') + "\n";
  row += fmt::format(",{},{},{},{},{}", csv_number(a->time_s, 9), csv_field(a->label),
                     csv_field(a->recording), a->status, a->verdict);
  row += fmt::format(",{},{},{}", csv_number(a->rms_mm, 4), csv_number(a->max_mm, 4),
                     csv_number(a->chi2_per_dof, 4));
  row += "," + laid_fields(a->registration);
  for (const std::string& m : muscles)
    for (const auto* told :
         {&a->activation, &a->forces_N, &a->sd_N, &a->acts, &a->median_N, &a->low_N, &a->high_N})
      row += "," + csv_number(*told, m, 5);
  return row + "\n";
}

std::string corpus_table(const Plan& plan, const CorpusResults& results) {
  const std::set<std::string> muscles = muscles_of(results);
  std::string csv =
      "recording,file,speaker,frame,time_s,label,take,status,verdict,rms_mm,max_mm,chi2_per_dof," +
      laid_titles();
  for (const std::string& m : muscles)
    csv += fmt::format(
        ",{0}_activation,{0}_N,{0}_sd_N,{0}_acts,{0}_median_N,{0}_low90_N,{0}_high90_N", m);
  csv += "\n";
  for (size_t r = 0; r < plan.recordings.size(); ++r)
    for (const int frame : plan.recordings[r].frames) {
      const auto it = results.answers[r].find(frame);
      csv += frame_row(plan.recordings[r], frame,
                       it == results.answers[r].end() ? nullptr : &it->second, muscles);
    }
  return csv;
}

std::string words_of_counts(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, n] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, name);
  return text;
}

}  // namespace

Json corpus_json(const Plan& plan, const CorpusResults& results) {
  const FrameCounts counts = all_frames(plan, results);
  const Json refused = refused_json(plan);
  Json json{{"recordings", plan.recordings.size()},
            {"refused", refused},
            {"refused_share", double(refused.size()) / double(plan.recordings.size())},
            {"frames", counts.frames},
            {"answered", counts.answered},
            {"status", counts.status},
            {"verdict", counts.verdict},
            {"shares", shares_json(counts)},
            {"doubtful", counts.doubtful},
            {"tasks", plan.tasks.size()},
            {"open_tasks", results.open},
            {"failed", failed_json(results)},
            {"wall_s", results.wall_s},
            {"cpu_s", results.cpu_s},
            {"by_recording", Json::array()}};
  for (size_t r = 0; r < plan.recordings.size(); ++r)
    json["by_recording"].push_back(recording_json(plan.recordings[r], results.answers[r]));
  return json;
}

std::string corpus_text(const Plan& plan, const CorpusResults& results) {
  const FrameCounts c = all_frames(plan, results);
  const Json refused = refused_json(plan);
  std::string text =
      fmt::format("{} recordings, {} refused; {} frames, tasks: {}\nstatus   {}\nverdict  {}\n",
                  plan.recordings.size(), refused.size(), c.frames, plan.tasks.size(),
                  words_of_counts(c.status), words_of_counts(c.verdict));
  for (const PlannedRecording& r : plan.recordings)
    if (!r.refused.empty())
      text += fmt::format("refused  {} (line {}): {}\n", r.name, r.line, r.refused);
  for (const TaskFailure& f : results.failures)
    text += fmt::format("failed   task {}{}{}: {}\n", f.task, f.recording.empty() ? "" : ", ",
                        f.recording, f.reason);
  return text;
}

void write_corpus(const std::string& out, const Plan& plan, const CorpusResults& results) {
  write_results(out, plan, results);
  for (size_t r = 0; r < plan.recordings.size(); ++r)
    if (!results.answers[r].empty())
      write_summary(results.answers[r], out + "/" + plan.recordings[r].name);
  write_text(out + "/results.csv", corpus_table(plan, results));
  write_text(out + "/corpus.json",
             corpus_json(plan, results).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace genio
