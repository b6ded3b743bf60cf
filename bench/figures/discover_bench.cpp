#include "bench/figures/discover_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "bench/figures/discover.hpp"
#include "bench/figures/discover_table.hpp"
#include "forward/model/model_file.hpp"
#include "runs/process/progress_line.hpp"
#include "runs/process/workers.hpp"
#include "runs/results/line_log.hpp"

namespace genio::bench {
namespace {

/// The cases that the options ask for, in a random order of theirs.
std::vector<HiddenCase> chosen_cases(const BenchOptions& o) {
  std::vector<HiddenCase> cases = discover_cases();
  std::mt19937 random(o.seed);
  std::shuffle(cases.begin(), cases.end(), random);
  std::erase_if(cases,
                [&](const HiddenCase& c) { return c.name.find(o.only) == std::string::npos; });
  if (cases.empty())
    throw InputError(
        fmt::format("bench discover: no data set's name contains \"{}\"; expected something like "
                    "gravity-1-known",
                    o.only));
  if (o.sample > 0 && size_t(o.sample) < cases.size()) cases.resize(size_t(o.sample));
  return cases;
}

Json run_discover(const BenchOptions& o, const Progress&) {
  const std::string folder = o.out.empty() ? "bench-discover" : o.out;
  std::vector<HiddenCase> cases = chosen_cases(o);
  std::filesystem::create_directories(folder);
  std::vector<Json> results;
  const auto take_up = [&](const std::string& line) {
    const auto known = Json::parse(line, nullptr, false);
    if (!known.is_object() || !known.contains("case")) return false;
    if (std::erase_if(cases, [&](const HiddenCase& c) { return c.name == known["case"]; }) > 0)
      results.push_back(known);
    return true;
  };
  LineLog log(folder + (o.only_data ? "/prepared.jsonl" : "/results.jsonl"), take_up);
  const ModelDescription tongue = read_description(o.model);
  const int workers = std::clamp(o.threads, 1, std::max(1, int(cases.size())));
  ProgressLine progress(int(results.size()), int(results.size() + cases.size()), "data sets");
  const auto work = [&](int w, const Send& send) {
    KnownShapes known;
    for (size_t k = size_t(w); k < cases.size(); k += size_t(workers))
      send((o.only_data ? prepare_discover_case(tongue, cases[k], folder, known)
                        : run_discover_case(tongue, cases[k], folder, known))
               .dump());
  };
  const auto collect = [&](const std::string& line) {
    log.add(line);
    results.push_back(Json::parse(line));
    progress.step();
  };
  if (!cases.empty()) in_processes(workers, work, collect);
  if (o.only_data) return {{"prepared", results.size()}};
  return discover_figures(results);
}

}  // namespace

Benchmark discover_bench() {
  return {.name = "discover",
          .about = "Effects hidden in data of a finer tongue, named or not",
          .options = {{"--sample", "data sets (all)"},
                      {"--threads", "data sets at a time"},
                      {"--only-data", "make the data sets, run nothing"},
                      {"--only", "data sets whose names contain this"},
                      {"--seed", "which random cases a sample takes"},
                      {"--out", "folder for data and results"}},
          .run = run_discover};
}

}  // namespace genio::bench
