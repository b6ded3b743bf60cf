#include "bench/figures/corpus.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "bench/experiments/recordings/synthetic_corpus.hpp"
#include "forward/base/elapsed.hpp"
#include "forward/base/text_file.hpp"
#include "runs/process/program.hpp"
#include "runs/results/answer_record.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

struct Cost {
  double cpu_s = 0, wall_s = 0;
  std::string said = {};
};

/// Runs `genio corpus`; a refused recording is no reason to stop, and anything else is.
Cost genio_corpus(std::vector<std::string> words) {
  const std::string program = fs::read_symlink("/proc/self/exe").parent_path() / "genio";
  words.insert(words.begin(), {program, "corpus"});
  const Stopwatch watch;
  const double before = children_seconds();
  const ProgramEnd end = run_program(words);
  if (end.status > 1) throw std::runtime_error("genio corpus: " + end.said);
  return {children_seconds() - before, watch.seconds(), end.said};
}

Json read_json(const std::string& path) {
  std::ifstream in(path);
  return Json::parse(in);
}

/// Tasks of an array that run now, as "12_3".
std::vector<std::string> running(const std::string& job) {
  std::istringstream in(
      run_program({"squeue", "--noheader", "--array", "--states=R", "--format=%i", "--jobs=" + job})
          .said);
  std::vector<std::string> tasks;
  for (std::string word; in >> word;)
    if (word.find('_') != std::string::npos) tasks.push_back(word);
  return tasks;
}

/// Waits until no job is left, and puts `kills` running tasks back at random on the way.
int wait_for(const Json& jobs, int kills, std::mt19937& random) {
  const std::string array = jobs.at("array_job"), merge = jobs.at("merge_job");
  int killed = 0;
  for (int round = 1;; ++round) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const ProgramEnd left =
        run_program({"squeue", "--noheader", fmt::format("--jobs={},{}", array, merge)});
    if (left.said.find_first_not_of(" \n") == std::string::npos || left.status != 0) return killed;
    const auto tasks = running(array);
    if (killed >= kills || round % 7 != 0 || tasks.empty()) continue;
    killed += run_program({"scontrol", "requeue", tasks[random() % tasks.size()]}).status == 0;
  }
}

struct ArrayRun {
  double plan_cpu_s = 0, tasks_cpu_s = 0, wall_s = 0;
  int killed = 0;
};

ArrayRun run_array(const std::string& manifest, const std::string& out, int kills,
                   std::mt19937& random) {
  const Stopwatch watch;
  const Cost submitted = genio_corpus({manifest, "--out", out, "--slurm", "--json", "--quiet"});
  ArrayRun run;
  const Json jobs = Json::parse(submitted.said.substr(submitted.said.rfind("{\"array_job\"")));
  run.killed = wait_for(jobs, kills, random);
  run.plan_cpu_s = submitted.cpu_s, run.wall_s = watch.seconds();
  run.tasks_cpu_s = read_json(out + "/corpus.json").at("cpu_s");
  return run;
}

/// The lines of all recordings of a corpus, by recording and frame; `twice` counts what stands
/// there again, in them or in the merged table.
using Lines = std::map<std::pair<std::string, int>, AnswerRecord>;
Lines lines_of(const std::string& out, int& twice) {
  Lines lines;
  const Json corpus = read_json(out + "/corpus.json");
  for (const Json& r : corpus.at("by_recording")) {
    const std::string name = r.at("recording");
    std::ifstream in(fmt::format("{}/{}/results.jsonl", out, name));
    for (std::string line; std::getline(in, line);)
      if (const auto a = read_record(line))
        twice += !lines.try_emplace({name, a->frame}, *a).second;
  }
  std::set<std::string> rows;
  std::ifstream table(out + "/results.csv");
  for (std::string row; std::getline(table, row);) {
    std::istringstream in(row);
    std::string name, cell;
    std::getline(in, name, ',');
    for (int k = 0; k < 3; ++k) std::getline(in, cell, ',');
    twice += !rows.insert(fmt::format("{},{}", name, cell)).second;
  }
  return lines;
}

/// How two runs of one corpus differ: frames that agree() calls different, and lacking ones.
Json difference(const std::string& one, const std::string& other) {
  int twice = 0, different = 0, missing = 0, exact = 0;
  const Lines a = lines_of(one, twice), b = lines_of(other, twice);
  for (const auto& [key, answer] : a) {
    const auto it = b.find(key);
    missing += it == b.end();
    if (it == b.end()) continue;
    different += !agree(answer, it->second);
    exact += answer.forces_N == it->second.forces_N;
  }
  for (const auto& [key, answer] : b) missing += !a.contains(key);
  if (a.empty()) throw std::runtime_error(one + ": holds no answers to compare");
  return {{"frames", a.size()},
          {"same_to_the_last_digit", exact},
          {"different", different},
          {"missing", missing},
          {"twice", twice}};
}

/// The share of the tasks' time in which frames were answered [by the wall clock].
double answering(const std::string& out) {
  int twice = 0;
  double answers = 0;
  for (const auto& [key, answer] : lines_of(out, twice)) answers += answer.wall_s;
  return answers / read_json(out + "/corpus.json").at("wall_s").get<double>();
}

void add_array_figures(Json& figures, const std::string& manifest, const std::string& folder,
                       const Cost& here, std::mt19937& random, const Progress& progress) {
  const int kills = std::max(1, figures.at("tasks").get<int>() / 3);
  progress("as a job array, undisturbed");
  const ArrayRun whole = run_array(manifest, folder + "/array", 0, random);
  const double merge = genio_corpus({"--merge", "--out", folder + "/array"}).cpu_s;
  progress(fmt::format("as a job array, {} tasks killed at random", kills));
  const ArrayRun killed = run_array(manifest, folder + "/killed", kills, random);
  const double total = whole.plan_cpu_s + whole.tasks_cpu_s + merge;
  figures["array"] = {{"cpu_s", total},
                      {"plan_and_submit_cpu_s", whole.plan_cpu_s},
                      {"tasks_cpu_s", whole.tasks_cpu_s},
                      {"merge_cpu_s", merge},
                      {"wall_s", whole.wall_s}};
  figures["overhead_percent"] = 100 * (total / here.cpu_s - 1);
  figures["array_and_here"] = difference(folder + "/here", folder + "/array");
  figures["killed"] = difference(folder + "/here", folder + "/killed");
  figures["killed"]["tasks"] = killed.killed;
  figures["killed"]["failed"] = read_json(folder + "/killed/corpus.json").at("failed");
}

bool has_slurm() {
  try {
    return run_program({"sinfo", "--noheader"}).status == 0;
  } catch (const std::exception&) {
    return false;
  }
}

Json run_corpus(const BenchOptions& o, const Progress& progress) {
  const bool kept = !o.out.empty();
  const std::string folder =
      fs::absolute(
          kept ? o.out
               : (fs::temp_directory_path() / fmt::format("genio_corpus_{}", getpid())).string())
          .string();
  make_folder(folder);
  SyntheticCorpus corpus;
  corpus.seed = o.seed;
  if (o.sample > 0) corpus.frames = o.sample;
  const std::string manifest = write_corpus_files(corpus, o.model, folder + "/recordings");
  if (o.only_data) return {{"manifest", manifest}};
  progress("on this machine");
  const Cost here = genio_corpus({manifest, "--out", folder + "/here", "--threads",
                                  std::to_string(o.threads), "--json", "--quiet"});
  const Json summary = read_json(folder + "/here/corpus.json");
  Json figures{{"recordings", summary.at("recordings")},
               {"speakers", corpus.speakers},
               {"refused", summary.at("refused").size()},
               {"frames", summary.at("frames")},
               {"tasks", summary.at("tasks")},
               {"shares", summary.at("shares")},
               {"here", {{"cpu_s", here.cpu_s}, {"wall_s", here.wall_s}}},
               {"answering_share", answering(folder + "/here")}};
  std::mt19937 random(o.seed);
  if (has_slurm()) add_array_figures(figures, manifest, folder, here, random, progress);
  else figures["array"] = nullptr;
  if (!kept) fs::remove_all(folder);
  return figures;
}

}  // namespace

Benchmark corpus_bench() {
  return {.name = "corpus",
          .about = "60 recordings of 3 speakers here and, where Slurm is, as a job array",
          .options = {{"--sample", "frames a recording (8)"},
                      {"--threads", "worker processes (1)"},
                      {"--only-data", "only write recordings and manifest into --out"},
                      {"--out", "a new folder that keeps all; else a temporary one"},
                      {"--seed", "which are drawn"}},
          .run = run_corpus};
}

}  // namespace genio::bench
