#include "bench/figures/service/service.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/figures/service/kills.hpp"
#include "bench/figures/service/questions.hpp"
#include "bench/figures/service/round_trips.hpp"
#include "bench/figures/service/under_attack.hpp"

namespace genio::bench {
namespace {

constexpr int distinct_questions = 20, usual_requests = 400;
constexpr double attacked_s = 5;  // by each kind

/// Goes with the object.
struct ScratchFolder {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("genio-service-" + std::to_string(getpid()));
  ScratchFolder() { std::filesystem::create_directory(path); }
  ~ScratchFolder() { std::filesystem::remove_all(path); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
};

Json run_service(const BenchOptions& o, const Progress& progress) {
  std::vector<ServedModel> models = read_served_models({o.model});
  const Model& model = *models.front().model;
  const auto questions = quick_questions(model, distinct_questions);
  const shape_request_t lasting = long_question(model);
  const ScratchFolder folder;
  const std::string computed = folder.path / "computed";
  const int requests = o.sample > 0 ? o.sample : usual_requests;
  const char* provider = std::getenv("LCM_DEFAULT_URL");
  // All of them before there is a thread.
  ServerProcess one(models, {.workers = 1}), two(models, {.workers = 2}),
      attacked(models, {.journal = folder.path / "attacked.db", .workers = 1}),
      killed(models, {.url = provider ? provider : "",
                      .journal = folder.path / "journal.db",
                      .computed = computed,
                      .workers = 2});
  const auto asked_for = [&](const char* part) { return o.only.empty() || o.only == part; };
  Json figures;
  if (asked_for("overhead")) {
    one.start();
    figures.update(overheads(one.url(), questions, requests));
    progress("overhead is measured");
  }
  if (asked_for("throughput") || asked_for("deadlines")) two.start();
  if (asked_for("throughput")) {
    if (!asked_for("overhead")) one.start();
    const int each = std::max(5, requests / 20);
    const double single = throughput(one.url(), questions, 4, each);
    figures["throughput_2_over_1"] = throughput(two.url(), questions, 4, each) / single;
    figures["requests_per_s"] = single;
    progress("throughput is measured");
  }
  if (asked_for("deadlines")) {
    figures.update(deadlines(two.url(), lasting, std::max(20, requests / 4), o.seed));
    figures.update(beside_long(two.url(), lasting, questions));
    progress("deadlines are measured");
  }
  if (o.only == "memory") {  // not usual, as its figures only tell something of many requests
    one.start();
    figures.update(memory_of_many(one.url(), lasting, requests));
  }
  if (asked_for("attacks")) {
    attacked.start();
    figures.update(under_attack(attacked, questions.front(), attacked_s, progress));
  }
  if (asked_for("kills")) {
    killed.start();
    KillPlan plan;
    plan.requests = requests, plan.seed = o.seed;
    figures.update(killed_service(killed, computed, questions, plan, progress));
  }
  return figures;
}

}  // namespace

Benchmark service_bench() {
  return {
      .name = "service",
      .about = "Requests over LCM on 127.0.0.1: overhead, throughput, deadlines, attacks and kills",
      .options = {{"--sample", "requests (400)"},
                  {"--seed", "which workers are killed"},
                  {"--only",
                   "overhead, throughput, deadlines, attacks, memory or kills (these over "
                   "LCM_DEFAULT_URL, if that is set)"}},
      .run = run_service};
}

}  // namespace genio::bench
