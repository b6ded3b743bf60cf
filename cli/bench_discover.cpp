#include "cli/bench_discover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "bench/figures/discover_table.hpp"
#include "runs/process/progress_line.hpp"
#include "runs/process/workers.hpp"
#include "runs/results/line_log.hpp"

namespace genio::cli {

using bench::HiddenCase;

nlohmann::json bench_discover(const std::string& model, const std::string& folder, int sample,
                              unsigned seed, int threads, bool only_data, const std::string& only) {
  std::vector<HiddenCase> cases = bench::discover_cases();
  std::mt19937 random(seed);
  std::shuffle(cases.begin(), cases.end(), random);
  std::erase_if(cases, [&](const HiddenCase& c) { return c.name.find(only) == std::string::npos; });
  if (cases.empty())
    throw InputError(
        fmt::format("bench discover: no data set's name contains \"{}\"; expected something like "
                    "gravity-1-known",
                    only));
  if (sample > 0 && size_t(sample) < cases.size()) cases.resize(size_t(sample));
  std::filesystem::create_directories(folder);
  std::vector<nlohmann::json> results;
  const auto take_up = [&](const std::string& line) {
    const auto known = nlohmann::json::parse(line, nullptr, false);
    if (!known.is_object() || !known.contains("case")) return false;
    if (std::erase_if(cases, [&](const HiddenCase& c) { return c.name == known["case"]; }) > 0)
      results.push_back(known);
    return true;
  };
  LineLog log(folder + (only_data ? "/prepared.jsonl" : "/results.jsonl"), take_up);
  const ModelDescription tongue = read_description(model);
  const int workers = std::clamp(threads, 1, std::max(1, int(cases.size())));
  ProgressLine progress(int(results.size()), int(results.size() + cases.size()), "data sets");
  const auto work = [&](int w, const Send& send) {
    bench::KnownShapes known;
    for (size_t k = size_t(w); k < cases.size(); k += size_t(workers))
      send((only_data ? bench::prepare_discover_case(tongue, cases[k], folder, known)
                      : bench::run_discover_case(tongue, cases[k], folder, known))
               .dump());
  };
  const auto collect = [&](const std::string& line) {
    log.add(line);
    results.push_back(nlohmann::json::parse(line));
    progress.step();
  };
  if (!cases.empty()) in_processes(workers, work, collect);
  return only_data ? nlohmann::json{{"prepared", results.size()}}
                   : bench::discover_figures(results);
}

}  // namespace genio::cli
