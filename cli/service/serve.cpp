#include "cli/service/serve.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <memory>

#include "cli/support.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "server/hub/hub.hpp"
#include "server/link.hpp"
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
  auto model = std::make_shared<std::string>(default_model());
  auto queue = std::make_shared<int>(256);
  auto journal = std::make_shared<std::string>();
  auto key = std::make_shared<std::string>();
  options.add("--lcm", *url, "LCM URL (default: LCM_DEFAULT_URL, else tcpq://127.0.0.1:7700)");
  options.add("--model", *model, "Model folder or model.toml");
  options.add("--queue", *queue, "Requests that may wait", {.range = {{1, 100000}}});
  options.add("--journal", *journal,
              "File that keeps requests and replies beyond this process (default: none)");
  options.add("--key", *key,
              "Key file (see genio key): who has no such key may not ask (default: everyone may)");
  options.footer("Example: genio serve --lcm tcpq://127.0.0.1:7700");
  return [=]() -> int {
    ServiceOptions service;
    if (!key->empty()) service.key = read_key_file(*key);
    const Model m = read_model(*model);
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
    fmt::print(stderr, "genio: serving '{}' on {}{}\n", m.name, service.url,
               service.journal.empty()
                   ? "; without --journal, requests that wait are lost if this process is killed"
                   : "");
    serve(m, service, stop_requested);
    if (hub) hub->flush(longest_flush);
    return done;
  };
}

}  // namespace genio::cli
