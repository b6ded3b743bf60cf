#include "cli/bench_discover.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "bench/discover_table.hpp"
#include "cli/progress_line.hpp"
#include "cli/workers.hpp"

namespace genio::cli {
namespace {

namespace fs = std::filesystem;
using bench::HiddenCase;

/// Results that are there already, of these cases.
std::vector<nlohmann::json> known_results(const std::string& path,
                                          const std::vector<HiddenCase>& cases) {
  std::set<std::string> wanted;
  for (const HiddenCase& c : cases) wanted.insert(c.name);
  std::vector<nlohmann::json> results;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    // An interrupted write leaves a last line that is none.
    nlohmann::json j = nlohmann::json::parse(line, nullptr, false);
    if (!j.is_discarded() && wanted.erase(j.value("case", ""))) results.push_back(std::move(j));
  }
  return results;
}

}  // namespace

nlohmann::json bench_discover(const std::string& model, const std::string& folder, int sample,
                              unsigned seed, int threads) {
  std::vector<HiddenCase> cases = bench::discover_cases();
  std::mt19937 random(seed);
  std::shuffle(cases.begin(), cases.end(), random);
  if (sample > 0 && size_t(sample) < cases.size()) cases.resize(size_t(sample));
  fs::create_directories(folder);
  const std::string path = folder + "/results.jsonl";
  std::vector<nlohmann::json> results = known_results(path, cases);
  std::set<std::string> ready;
  for (const auto& r : results) ready.insert(r["case"]);
  std::erase_if(cases, [&](const HiddenCase& c) { return ready.contains(c.name); });
  const ModelDescription tongue = read_description(model);
  const int workers = std::clamp(threads, 1, std::max(1, int(cases.size())));
  ProgressLine progress(int(results.size()), int(results.size() + cases.size()), "data sets");
  std::ofstream out(path, std::ios::app);
  const auto work = [&](int w, const Send& send) {
    for (size_t k = size_t(w); k < cases.size(); k += size_t(workers))
      send(bench::run_discover_case(tongue, cases[k], folder));
  };
  const auto collect = [&](const nlohmann::json& j) {
    out << j.dump() << "\n" << std::flush;
    results.push_back(j);
    progress.step();
  };
  if (!cases.empty()) in_processes(workers, work, collect);
  return bench::discover_figures(results);
}

}  // namespace genio::cli
