#include "cli/service/serve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <csignal>
#include <memory>

#include "cli/support.hpp"
#include "server/hub/hub.hpp"
#include "server/link.hpp"
#include "server/served_model.hpp"
#include "server/service.hpp"
#include "server/tcp_address.hpp"

namespace genio::cli {
namespace {

// For the last replies to reach those who wait for them.
constexpr std::chrono::seconds longest_flush{3};

std::atomic<bool> stop_requested{false};

}  // namespace

Runner add_serve(Options& options) {
  auto url = std::make_shared<std::string>();
  auto models = std::make_shared<std::vector<std::string>>();
  auto workers = std::make_shared<WorkerLimits>();
  auto queue = std::make_shared<int>(256);
  auto journal = std::make_shared<std::string>();
  options.add("--lcm", *url, "LCM URL (default: LCM_DEFAULT_URL, else tcpq://127.0.0.1:7700)");
  options.add(
      "--model", *models,
      "Model folder or model.toml, or NAME=FOLDER; again for another one that requests name");
  options.add("--workers", workers->count, "Processes that compute", {.range = {{1, 256}}});
  options.add("--worker-memory-mb", workers->memory_mb,
              "Memory that one may take; beyond, it is replaced", {.positive = true});
  options.add("--worker-silence-s", workers->silence_s,
              "Time without a sign of life after which one is replaced", {.positive = true});
  options.add("--queue", *queue, "Requests that may wait", {.range = {{1, 100000}}});
  options.add("--journal", *journal,
              "File that keeps requests and replies beyond this process (default: none)");
  options.footer("Example: genio serve --lcm tcpq://127.0.0.1:7700");
  return [=]() -> int {
    if (models->empty()) models->push_back(default_model());
    std::vector<ServedModel> served = read_served_models(*models);
    const std::vector<ModelIdentity> names = identities(served);
    // Before there is any thread or connection: processes are forked off.
    const Nursery nursery(worker_of(served, workers->memory_mb));
    ServiceOptions service;
    service.workers = *workers;
    service.url = choose_url(*url);
    service.limits.waiting = *queue;
    service.journal = *journal;
    service.log = print_line;
    std::unique_ptr<Hub> hub;
    if (const uint16_t port = local_tcpq_port(service.url)) {
      try {
        hub = std::make_unique<Hub>(port);
      } catch (const std::exception& e) {
        throw InputError(fmt::format("--lcm {}: {}", service.url, e.what()));
      }
    }
    std::signal(SIGINT, [](int) { stop_requested = true; });
    std::signal(SIGTERM, [](int) { stop_requested = true; });
    if (hub) service.hub = [&] { return hub->counts(); };
    std::vector<std::string> quoted;
    for (const ModelIdentity& m : names) quoted.push_back("'" + m.name + "'");
    fmt::print(stderr, "genio: serving {} on {}{}\n", fmt::join(quoted, ", "), service.url,
               service.journal.empty()
                   ? "; without --journal, requests that wait are lost if this process is killed"
                   : "");
    serve(nursery, names, service, stop_requested);
    if (hub) hub->flush(longest_flush);
    return done;
  };
}

}  // namespace genio::cli
