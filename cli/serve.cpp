#include <fmt/format.h>

#include <csignal>
#include <memory>

#include "cli/commands.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "server/hub.hpp"
#include "server/link.hpp"
#include "server/service.hpp"

namespace genio::cli {
namespace {

std::atomic<bool> stop_requested{false};

}  // namespace

Runner add_serve(CLI::App& app) {
  auto url = std::make_shared<std::string>();
  auto model = std::make_shared<std::string>(default_model());
  auto queue = std::make_shared<int>(256);
  app.add_option("--lcm", *url, "LCM URL (default: LCM_DEFAULT_URL, else tcpq://127.0.0.1:7700)");
  app.add_option("--model", *model, "Model folder or model.toml");
  app.add_option("--queue", *queue, "Requests that may wait")->check(CLI::Range(1, 100000));
  app.footer("Example: genio serve --lcm tcpq://127.0.0.1:7700");
  return [=]() -> int {
    const Model m = read_model(*model);
    ServiceOptions options;
    options.url = choose_url(*url);
    options.queue = *queue;
    options.log = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
    std::unique_ptr<Hub> hub;
    if (const uint16_t port = local_tcpq_port(options.url)) {
      try {
        hub = std::make_unique<Hub>(port);
      } catch (const std::exception& e) {
        throw InputError(fmt::format("--lcm {}: {}", options.url, e.what()));
      }
    }
    std::signal(SIGINT, [](int) { stop_requested = true; });
    std::signal(SIGTERM, [](int) { stop_requested = true; });
    fmt::print(stderr, "genio: serving '{}' on {}\n", m.name, options.url);
    serve(m, options, stop_requested);
    return done;
  };
}

}  // namespace genio::cli
