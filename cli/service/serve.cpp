#include "cli/service/serve.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <memory>

#include "cli/support.hpp"
#include "server/hub/hub.hpp"
#include "server/link/link.hpp"
#include "server/link/tcp_address.hpp"
#include "server/log/log.hpp"
#include "server/metrics/metrics_endpoint.hpp"
#include "server/observe/observer.hpp"
#include "server/served_model.hpp"
#include "server/service.hpp"

namespace genio::cli {
namespace {

// For the last replies to reach those who wait for them.
constexpr std::chrono::seconds longest_flush{3};

std::atomic<bool> stop_requested{false};

/// What takes a port; a port that is taken is an error of the option.
template <class Taker>
std::unique_ptr<Taker> taking(uint16_t port, const std::string& option) {
  try {
    return std::make_unique<Taker>(port);
  } catch (const std::exception& e) {
    throw InputError(fmt::format("{}: {}", option, e.what()));
  }
}

std::vector<LogField> facts_of(const ServiceOptions& service, int metrics_port) {
  std::vector<LogField> facts = {{"url", service.url}};
  if (metrics_port > 0) facts.push_back({"metrics_port", int64_t(metrics_port)});
  if (service.key) facts.push_back({"key", "asked for"});
  if (service.journal.empty())
    facts.push_back(
        {"remark", "without --journal, requests that wait are lost if this process is killed"});
  else facts.push_back({"journal", service.journal});
  return facts;
}

}  // namespace

Runner add_serve(Options& options) {
  auto url = std::make_shared<std::string>();
  auto models = std::make_shared<std::vector<std::string>>();
  auto workers = std::make_shared<WorkerLimits>();
  auto queue = std::make_shared<int>(256);
  auto metrics_port = std::make_shared<int>(0);
  auto journal = std::make_shared<std::string>();
  auto key = std::make_shared<std::string>();
  auto log_json = std::make_shared<bool>(false);
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
  options.add("--key", *key,
              "Key file (see genio key): who has no such key may not ask (default: everyone may)");
  options.add("--metrics-port", *metrics_port,
              "Port of 127.0.0.1 for /metrics, in Prometheus' text format (default: none)",
              {.range = {{0, 65535}}});
  options.flag("--log-json", *log_json, "Log on standard error as one JSON object a line");
  options.footer("Example: genio serve --lcm tcpq://127.0.0.1:7700");
  return [=]() -> int {
    if (models->empty()) models->push_back(default_model());
    ServiceManager manager = ServiceManager::from_environment();
    std::vector<ServedModel> served = read_served_models(*models);
    const std::vector<ModelIdentity> names = identities(served);
    // Before there is any thread or connection: processes are forked off.
    const Nursery nursery(worker_of(served, workers->memory_mb));
    std::signal(SIGPIPE, SIG_IGN);  // of whoever reads the log
    Log log(*log_json ? LogForm::json : LogForm::text);
    ServiceOptions service;
    service.workers = *workers;
    service.url = choose_url(*url);
    if (!key->empty()) service.key = read_key_file(*key);  // which the workers need not know
    service.limits.waiting = *queue;
    service.journal = *journal;
    std::unique_ptr<Hub> hub;
    if (const uint16_t port = local_tcpq_port(service.url))
      hub = taking<Hub>(port, "--lcm " + service.url);
    std::unique_ptr<MetricsEndpoint> metrics;
    if (*metrics_port > 0)
      metrics = taking<MetricsEndpoint>(uint16_t(*metrics_port),
                                        fmt::format("--metrics-port {}", *metrics_port));
    if (hub) {
      service.hub = [&] { return hub->counts(); };
      service.connected_from = [&](uint16_t port) { hub->favour(port); };
    }
    Observer observer(
        {&log, metrics.get(), &manager, service.hub, facts_of(service, *metrics_port)});
    service.observer = &observer;
    std::signal(SIGINT, [](int) { stop_requested = true; });
    std::signal(SIGTERM, [](int) { stop_requested = true; });
    serve(nursery, names, service, stop_requested);
    if (hub) hub->flush(longest_flush);
    return done;
  };
}

}  // namespace genio::cli
