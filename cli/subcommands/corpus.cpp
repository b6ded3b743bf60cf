#include "cli/subcommands/corpus.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command_line/command_line.hpp"
#include "cli/frame_files.hpp"
#include "cli/option_sets/inversion_options.hpp"
#include "cli/support.hpp"
#include "report/answers/corpus_report.hpp"
#include "runs/corpus/slurm.hpp"
#include "runs/process/progress_line.hpp"
#include "runs/process/workers.hpp"

namespace genio::cli {
namespace {

namespace fs = std::filesystem;

struct CorpusCommand {
  std::string manifest, out;
  PlanningOptions planning;
  int task = -1, at_once = 0;
  std::vector<std::string> sbatch;
  bool merge = false, slurm = false, json = false, quiet = false;
};

InversionOptions inversion_of(const std::vector<std::string>& words) {
  InversionOptions o;
  read_words("invert", words, [&](Options& options) { add_inversion_options(options, o); });
  return o;
}

AnswerFiles answer_files() { return {frame_message, write_movement}; }

/// Says how each recording was read, where it was not, and how far the reading is.
TakeRead reading(const CorpusCommand& o) {
  auto progress = std::make_shared<std::optional<ProgressLine>>();
  return [&o, progress](const PlannedRecording& r, int, int total) {
    if (!r.refused.empty())
      print_line(fmt::format("{}:{}: refused: {}", o.manifest, r.line, r.refused));
    if (o.quiet) return;
    if (!*progress) progress->emplace(0, total, "recordings read");
    (*progress)->step();
  };
}

int open_frames_of(const Plan& plan, const CorpusResults& results) {
  int frames = 0;
  for (size_t r = 0; r < plan.recordings.size(); ++r)
    frames += int(plan.recordings[r].frames.size() - results.answers[r].size());
  return frames;
}

/// Runs the open tasks in worker processes; what ends one is kept beside its lines.
void run_here(const CorpusCommand& o, const Plan& plan, const CorpusResults& before,
              Models& models) {
  const int open = open_frames_of(plan, before);
  if (open == 0) return;
  int total = 0;
  for (const PlannedRecording& r : plan.recordings) total += int(r.frames.size());
  ProgressLine progress(total - open, total);
  const auto task_of = [&](int k) { return before.open[size_t(k)]; };
  const auto work = [&](int k, const Send& send) {
    run_task(o.out, plan, task_of(k), inversion_of, models, answer_files(), [&] { send(""); });
  };
  const auto collect = [&](const std::string&) {
    if (!o.quiet) progress.step();
  };
  in_turn(int(before.open.size()), o.planning.processes, work, collect,
          [&](int k, const Ending& ending) {
            if (ending.how == How::died)
              write_failures(o.out, task_of(k), {{task_of(k), "", ending.reason}});
          });
}

/// Makes one of what the tasks have left; done where nothing is open or refused.
int merge(const CorpusCommand& o, const Plan& plan) {
  const CorpusResults results = corpus_results(o.out, plan);
  write_corpus(o.out, plan, results);
  const nlohmann::json json = corpus_json(plan, results);
  if (o.json)
    fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  else fmt::print("{}", corpus_text(plan, results));
  return results.open.empty() && json["refused"].empty() ? done : no_answer;
}

int run_slurm(const CorpusCommand& o, const Plan& plan, const CorpusResults& before) {
  const SlurmJob job{.program = fs::read_symlink("/proc/self/exe").string(),
                     .out = fs::absolute(o.out).lexically_normal().string(),
                     .tasks = before.open,
                     .at_once = o.at_once,
                     .options = o.sbatch};
  write_scripts(job);
  const SubmittedJobs jobs = submit(job);
  const int frames = open_frames_of(plan, before);
  if (o.json) {
    const nlohmann::json json{{"array_job", jobs.array},
                              {"merge_job", jobs.merge},
                              {"tasks", before.open},
                              {"frames", frames},
                              {"scripts", job.out + "/slurm"}};
    fmt::print("{}\n", json.dump());
    return done;
  }
  fmt::print(
      "job {}   an array of {} tasks with {} frames\njob {}   makes one of them, once they have "
      "ended\nlook     squeue -j {},{}\nlogs     {}/slurm\nthen     {}/results.csv, "
      "{}/corpus.json\n",
      jobs.array, before.open.size(), frames, jobs.merge, jobs.array, jobs.merge, job.out, job.out,
      job.out);
  return done;
}

int run_one(const CorpusCommand& o) {
  const Plan plan = read_plan(o.out);
  if (o.task >= int(plan.tasks.size()))
    throw InputError(
        fmt::format("--task {}: {} has tasks 0 to {}", o.task, o.out, int(plan.tasks.size()) - 1));
  Models models;
  ProgressLine progress(0, frames_of(plan.tasks[size_t(o.task)]));
  run_task(o.out, plan, o.task, inversion_of, models, answer_files(), [&] {
    if (!o.quiet) progress.step();
  });
  return done;
}

int run(const CorpusCommand& o) {
  if (!o.manifest.empty() && (o.task >= 0 || o.merge))
    throw InputError(
        fmt::format("{}: --task and --merge work on a corpus that is planned; give "
                    "--out alone",
                    o.manifest));
  if (o.task >= 0) return run_one(o);
  if (o.merge) return merge(o, read_plan(o.out));
  if (o.manifest.empty())
    throw InputError("corpus: a manifest is needed, as in genio corpus manifest.csv --out DIR");
  check_sbatch_options(o.sbatch);
  Models models;
  const Manifest manifest = read_manifest(o.manifest, inversion_of);
  const Plan plan = plan_corpus(manifest, o.out, o.planning, inversion_of, models, reading(o));
  const CorpusResults before = corpus_results(o.out, plan);
  if (o.slurm && !before.open.empty()) return run_slurm(o, plan, before);
  run_here(o, plan, before, models);
  return merge(o, plan);
}

}  // namespace

Runner add_corpus(Options& options) {
  auto o = std::make_shared<CorpusCommand>();
  options.add(
      "manifest", o->manifest,
      "CSV with the column recording, and where wanted palate, speaker, model, textgrid and "
      "options (of genio invert)");
  options.add("--out", o->out,
              "Folder of the corpus: results.csv, corpus.json, a folder a recording",
              {.required = true});
  options.add("--threads", o->planning.processes, "Worker processes; with --slurm, to read with",
              {.range = {{1, 256}}});
  options.add("--share", o->planning.share,
              "Frames a task (by the size of the corpus: 50 to 200, and at most 1000 tasks)",
              {.range = {{1, 1000000}}});
  options.flag("--resume", o->planning.resume,
               "Read new and refused recordings, and run only what is missing");
  options.flag("--slurm", o->slurm,
               "Submit the tasks as a job array of Slurm, and a job that merges");
  options.add("--at-once", o->at_once, "Tasks of the array that may run at one time",
              {.range = {{1, 100000}}, .only_with = {"--slurm"}});
  options.add("--sbatch-option", o->sbatch, "More for sbatch: --sbatch-option=--partition=long",
              {.only_with = {"--slurm"}});
  options.add("--task", o->task, "Run this task of a planned corpus, as the array does",
              {.range = {{0, 10000000}},
               .not_with = {"--merge", "--slurm", "--resume", "--share", "--threads", "--json"}});
  options.flag("--merge", o->merge, "Make one of what the tasks of a planned corpus have left",
               {.not_with = {"--slurm", "--resume", "--share", "--threads"}});
  options.flag("--json", o->json, "One JSON object on standard output");
  options.flag("--quiet", o->quiet, "No progress");
  options.footer(
      "Example: genio corpus data/examples/corpus.csv --out corpus --threads 2\n"
      "         genio corpus manifest.csv --out corpus --slurm --sbatch-option=--time=1:00:00");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
