#include "cli/bench_discover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "bench/figures/discover_table.hpp"
#include "cli/json_lines.hpp"
#include "cli/progress_line.hpp"
#include "cli/workers.hpp"

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
  JsonLines log(folder + (only_data ? "/prepared.jsonl" : "/results.jsonl"), "case");
  std::vector<nlohmann::json> results;
  for (const auto& known : log.known())
    if (std::erase_if(cases, [&](const HiddenCase& c) { return c.name == known["case"]; }) > 0)
      results.push_back(known);
  const ModelDescription tongue = read_description(model);
  const int workers = std::clamp(threads, 1, std::max(1, int(cases.size())));
  ProgressLine progress(int(results.size()), int(results.size() + cases.size()), "data sets");
  const auto work = [&](int w, const Send& send) {
    bench::KnownShapes known;
    for (size_t k = size_t(w); k < cases.size(); k += size_t(workers))
      send(only_data ? bench::prepare_discover_case(tongue, cases[k], folder, known)
                     : bench::run_discover_case(tongue, cases[k], folder, known));
  };
  const auto collect = [&](const nlohmann::json& j) {
    log.add(j);
    results.push_back(j);
    progress.step();
  };
  if (!cases.empty()) in_processes(workers, work, collect);
  return only_data ? nlohmann::json{{"prepared", results.size()}}
                   : bench::discover_figures(results);
}

}  // namespace genio::cli
